#include "core/errors.hpp"
