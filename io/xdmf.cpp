#include "io/xdmf.hpp"

#include <fmt/format.h>

namespace lampblack::io {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string dataItem(const std::string& dimensions, const char* type, const std::string& where) {
  return fmt::format("<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"8\" Format=\"HDF\">{}</DataItem>",
                     dimensions, type, escaped(where));
}

// ParaView takes 1, 3, 6 or 9 components for what they are; anything else is a matrix.
const char* attributeType(int components) {
  switch (components) {
    case 1:
      return "Scalar";
    case 3:
      return "Vector";
    case 6:
      return "Tensor6";
    case 9:
      return "Tensor";
    default:
      return "Matrix";
  }
}

// XDMF's word for cells of so many corners; nullptr where there are none.
const char* topologyOf(int dimension, int corners) {
  if (dimension == 2) return corners == 3 ? "Triangle" : corners == 4 ? "Quadrilateral" : nullptr;
  if (dimension != 3) return nullptr;
  switch (corners) {
    case 4:
      return "Tetrahedron";
    case 5:
      return "Pyramid";
    case 6:
      return "Wedge";
    case 8:
      return "Hexahedron";
    default:
      return nullptr;
  }
}

}  // namespace

bool isTopology(int dimension, int corners) {
  return topologyOf(dimension, corners) != nullptr;
}

std::int64_t topologyNumber(int dimension, int corners) {
  if (dimension == 2) return corners == 3 ? 4 : 5;
  return corners == 4 ? 6 : corners == 5 ? 7 : corners == 6 ? 8 : 9;
}

std::string xdmfStepText(const std::string& file, const XdmfMesh& mesh, const XdmfStep& step) {
  std::string text = fmt::format(
      "      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n"
      "        <Topology TopologyType=\"{}\" NumberOfElements=\"{}\">\n          {}\n        </Topology>\n"
      "        <Geometry GeometryType=\"XYZ\">\n          {}\n        </Geometry>\n",
      escaped(step.group), step.time, mesh.mixed > 0 ? "Mixed" : topologyOf(mesh.dimension, mesh.corners), mesh.cells,
      mesh.mixed > 0 ? dataItem(fmt::format("{}", mesh.mixed), "Int", file + ":/mesh/mixed")
                     : dataItem(fmt::format("{} {}", mesh.cells, mesh.corners), "Int", file + ":/mesh/cells"),
      dataItem(fmt::format("{} 3", mesh.vertices), "Float", file + ":/mesh/vertices"));
  for (const XdmfField& field : step.fields) {
    const std::string dimensions =
        field.components == 1 ? fmt::format("{}", mesh.cells) : fmt::format("{} {}", mesh.cells, field.components);
    text += fmt::format(
        "        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Cell\">\n          {}\n"
        "        </Attribute>\n",
        escaped(field.name), attributeType(field.components),
        dataItem(dimensions, field.isInteger ? "Int" : "Float", fmt::format("{}:{}/{}", file, step.group, field.name)));
  }
  return text + "      </Grid>\n";
}

std::string_view xdmfTail() {
  return "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

std::string xdmfText(const std::string& file, const XdmfMesh& mesh, const std::vector<XdmfStep>& steps) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (const XdmfStep& step : steps) text += xdmfStepText(file, mesh, step);
  return text.append(xdmfTail());
}

}  // namespace lampblack::io
