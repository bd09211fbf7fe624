#include "particles/soot/make_soot_model.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"
#include "particles/soot/dimer_soot.hpp"

namespace lampblack {
namespace {

struct Maker {
  std::unique_ptr<SootModel> operator()(const SootModelOptions& o) const { return std::make_unique<DimerSoot>(o); }
  std::unique_ptr<SootModel> operator()(const SemiEmpiricalOptions& o) const {
    return std::make_unique<SemiEmpiricalSoot>(o);
  }
  std::unique_ptr<SootModel> operator()(const SectionalSootOptions& o) const {
    return std::make_unique<SectionalSoot>(o);
  }
  std::unique_ptr<SootModel> operator()(const HmomOptions& o) const { return std::make_unique<HmomSoot>(o); }
  std::unique_ptr<SootModel> operator()(const MomicOptions& o) const { return std::make_unique<MomicSoot>(o); }
};

}  // namespace

const std::vector<std::string>& sootModelNames() {
  static const std::vector<std::string> names{"two_equation_dimer", "leung", "moss_brookes",
                                              "sectional",          "hmom",  "momic"};
  return names;
}

SootModelChoice publishedSootModel(std::string_view name) {
  if (name == "two_equation_dimer") return SootModelOptions{};
  if (name == "leung") return leungSoot();
  if (name == "moss_brookes") return mossBrookesSoot();
  if (name == "hmom") return HmomOptions{};
  if (name == "momic") return MomicOptions{};
  if (name == "sectional") {
    SectionalSootOptions options;
    options.soot.sootDensity = 1800;  // Wang (2025), chapter 9
    return options;
  }
  throw InputError(fmt::format("there is no soot model '{}'", name));
}

SootModelOptions* sharedOptions(SootModelChoice& choice) {
  if (auto* dimer = std::get_if<SootModelOptions>(&choice)) return dimer;
  if (auto* sectional = std::get_if<SectionalSootOptions>(&choice)) return &sectional->soot;
  if (auto* hmom = std::get_if<HmomOptions>(&choice)) return &hmom->soot;
  if (auto* momic = std::get_if<MomicOptions>(&choice)) return &momic->soot;
  return nullptr;
}

std::unique_ptr<SootModel> makeSootModel(const SootModelChoice& choice) {
  return std::visit(Maker{}, choice);
}

}  // namespace lampblack
