// An expression in a deck, "2*0.3*(1 - (r/0.005)^2)": a function of named variables, all in SI. Operators + - * / ^,
// comparisons, `condition ? a : b`, functions sin cos tan asin acos atan atan2 sinh cosh tanh exp ln log10 sqrt abs min
// max, and the constant pi (the parser is muParser).
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::io {

class Formula {
 public:
  // InputError where the text is no expression of these variables; the message says what is wrong with it.
  Formula(const std::string& text, const std::vector<std::string>& variables);

  // `values` in the order of the variables. InputError where the result is not a finite number. Copies share their
  // workspace: use one formula per thread.
  double operator()(std::span<const double> values) const;

  const std::string& text() const { return text_; }
  // Whether the expression has this variable in it.
  [[nodiscard]] bool has(const std::string& variable) const;

 private:
  struct Parser;
  std::string text_;
  std::shared_ptr<Parser> parser_;
};

}  // namespace lampblack::io
