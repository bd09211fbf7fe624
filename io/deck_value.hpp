// One value of a deck read as what its key says it is.
#pragma once

#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::io {

// Reads `node` as `key`; InputError pointing into `source` where it has another type, dimension, length or range.
// `otherNames`: what choices are called elsewhere.
DeckValue readDeckValue(const DeckSource& source, const DeckKey& key, const std::string& path, const DeckNode& node,
                        const OtherNames& otherNames = {});

// Reads the default of a key. A default that the key itself refuses is a mistake in the schema: std::logic_error.
DeckValue defaultDeckValue(const DeckKey& key, const std::string& path);

}  // namespace lampblack::io
