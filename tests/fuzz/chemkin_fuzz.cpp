// The CHEMKIN reader accepts files or says what is wrong with them; nothing else. What it accepts is written as YAML
// that reads back as the same mechanism.
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "chemistry/chemkin/chemkin_reader.hpp"
#include "chemistry/mechanism/mechanism_writer.hpp"
#include "core/errors.hpp"
#include "tests/scratch.hpp"

namespace {

// An input holds up to three files: mechanism, thermodynamic data, transport data, with this line between them.
constexpr std::string_view separator = "\n!====\n";

std::optional<lampblack::chemistry::ChemkinText> takeFile(std::string_view& rest, const char* name, bool& more) {
  if (!more) return std::nullopt;
  const auto end = rest.find(separator);
  more = end != std::string_view::npos;
  lampblack::chemistry::ChemkinText file{name, std::string(rest.substr(0, end))};
  if (more) rest.remove_prefix(end + separator.size());
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  bool more = true;
  const auto mechanism = takeFile(rest, "chem.inp", more);
  const auto thermo = takeFile(rest, "therm.dat", more);
  const auto transport = takeFile(rest, "tran.dat", more);
  std::string text;
  try {
    text = lampblack::chemistry::mechanismYaml(lampblack::chemistry::parseChemkin(*mechanism, thermo, transport));
  } catch (const lampblack::InputError&) {
    return 0;
  }
  const lampblack::test::ScratchFolder folder;
  if (lampblack::chemistry::mechanismYaml(
          lampblack::chemistry::Mechanism::fromFile(folder.file("mechanism.yaml", text))) != text)
    throw std::runtime_error("the YAML reads back as another mechanism");
  return 0;
}
