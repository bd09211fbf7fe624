#include "io/formula.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"

namespace lampblack::io {

struct Formula::Parser {
  mu::Parser expression;
  std::vector<std::string> names;
  std::vector<double> values;
};

Formula::Formula(const std::string& text, const std::vector<std::string>& variables)
    : text_(text), parser_(std::make_shared<Parser>()) {
  parser_->names = variables;
  parser_->values.assign(variables.size(), 1.0);
  try {
    parser_->expression.DefineConst("pi", std::numbers::pi);
    for (std::size_t i = 0; i < variables.size(); ++i) parser_->expression.DefineVar(variables[i], &parser_->values[i]);
    parser_->expression.SetExpr(text);
    parser_->expression.Eval();
    if (parser_->expression.GetNumResults() != 1) throw InputError("it has several results; expected one expression");
  } catch (const mu::ParserError& error) {
    throw InputError(fmt::format("the formula '{}' cannot be read: {}; its variables are {}", text, error.GetMsg(),
                                 fmt::join(variables, ", ")));
  } catch (const InputError& error) {
    throw InputError(fmt::format("the formula '{}' cannot be read: {}", text, error.what()));
  }
}

double Formula::operator()(std::span<const double> values) const {
  std::copy(values.begin(), values.end(), parser_->values.begin());
  double result = 0;
  try {
    result = parser_->expression.Eval();
  } catch (const mu::ParserError& error) {
    throw InputError(fmt::format("the formula '{}' cannot be evaluated: {}", text_, error.GetMsg()));
  }
  if (!std::isfinite(result)) {
    std::string where;
    for (std::size_t i = 0; i < values.size(); ++i)
      where += fmt::format("{}{} = {:g}", i > 0 ? ", " : "", parser_->names[i], values[i]);
    throw InputError(fmt::format("the formula '{}' gives no finite number at {}", text_, where));
  }
  return result;
}

bool Formula::has(const std::string& variable) const {
  return parser_->expression.GetUsedVar().contains(variable);
}

}  // namespace lampblack::io
