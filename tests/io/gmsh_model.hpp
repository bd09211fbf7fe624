// A small mesh as Gmsh would save it, written in any of the encodings of its file format.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "tests/every_module.hpp"

namespace lampblack::test {

struct GmshEncoding {
  bool version40 = false;
  bool binary = false;
  int sizeBytes = 8;
  bool version2 = false;  // 2.2
  [[nodiscard]] const char* version() const { return version2 ? "2.2" : version40 ? "4" : "4.1"; }
};

inline const std::vector<GmshEncoding>& gmshEncodings() {
  static const std::vector<GmshEncoding> all{{false, false, 8},     {true, false, 8}, {false, true, 8},
                                             {false, true, 4},      {true, true, 8},  {false, false, 8, true},
                                             {false, true, 8, true}};
  return all;
}

struct GmshModel {
  struct Entity {
    int dimension = 0, tag = 0;
    std::vector<int> groups;
  };
  struct Nodes {
    int dimension = 0, entity = 0;
    bool parametric = false;
    std::vector<std::pair<std::int64_t, std::array<double, 3>>> nodes;  // tag and place
  };
  struct Elements {
    int dimension = 0, entity = 0, type = 0;
    std::vector<std::vector<std::int64_t>> elements;  // tag, tags of nodes
  };
  struct Link {
    int dimension = 0, entity = 0, master = 0;
    bool affine = false;
    std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
  };
  std::vector<std::string> names;  // lines of $PhysicalNames
  std::vector<Entity> entities;
  std::vector<Nodes> nodes;
  std::vector<Elements> elements;
  std::vector<Link> links;
};

// Numbers of the format one after the other.
class GmshWriter {
 public:
  explicit GmshWriter(GmshEncoding encoding) : encoding_(encoding) {}

  GmshWriter& integer(std::int64_t value) { return put(static_cast<std::int32_t>(value)); }
  GmshWriter& size(std::int64_t value) {
    return encoding_.sizeBytes == 4 ? put(static_cast<std::uint32_t>(value)) : put(value);
  }
  GmshWriter& tag(std::int64_t value) {
    return encoding_.version40 || encoding_.version2 ? integer(value) : size(value);
  }
  GmshWriter& real(double value) { return put(value); }
  GmshWriter& end() { return encoding_.binary ? *this : raw("\n"); }
  GmshWriter& raw(const std::string& text) {
    text_ += text;
    return *this;
  }
  // Of version 4.0 in the other order.
  GmshWriter& owner(int dimension, int entity) {
    return encoding_.version40 ? integer(entity).integer(dimension) : integer(dimension).integer(entity);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  template <typename T>
  GmshWriter& put(T value) {
    if (!encoding_.binary) return raw(fmt::format("{} ", value));
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    text_.append(bytes, sizeof(T));
    return *this;
  }
  GmshEncoding encoding_;
  std::string text_;
};

inline std::string gmshEntitiesText(const GmshModel& model, const GmshEncoding& encoding) {
  GmshWriter out(encoding);
  for (int d = 0; d < 4; ++d) {
    std::int64_t count = 0;
    for (const auto& entity : model.entities) count += entity.dimension == d ? 1 : 0;
    out.size(count);
  }
  out.end();
  for (int d = 0; d < 4; ++d) {
    for (const auto& entity : model.entities) {
      if (entity.dimension != d) continue;
      out.integer(entity.tag);
      for (int k = 0; k < (d == 0 && !encoding.version40 ? 3 : 6); ++k) out.real(0.5 * k - 1);
      out.size(static_cast<std::int64_t>(entity.groups.size()));
      for (const int group : entity.groups) out.integer(group);
      if (d > 0) out.size(2).integer(1).integer(-2);
      out.end();
    }
  }
  return out.text();
}

inline std::string gmshNodesText(const GmshModel& model, const GmshEncoding& encoding) {
  GmshWriter out(encoding);
  std::int64_t total = 0;
  for (const auto& block : model.nodes) total += static_cast<std::int64_t>(block.nodes.size());
  out.size(static_cast<std::int64_t>(model.nodes.size())).size(total);
  if (!encoding.version40) out.size(1).size(2000000000);
  out.end();
  for (const auto& block : model.nodes) {
    out.owner(block.dimension, block.entity).integer(block.parametric ? 1 : 0);
    out.size(static_cast<std::int64_t>(block.nodes.size())).end();
    if (!encoding.version40)
      for (const auto& node : block.nodes) out.tag(node.first).end();
    for (const auto& [tag, place] : block.nodes) {
      if (encoding.version40) out.tag(tag);
      for (const double x : place) out.real(x);
      const bool none = !block.parametric || (encoding.version40 && block.dimension == 3);
      for (int k = 0; !none && k < block.dimension; ++k) out.real(77.5);
      out.end();
    }
  }
  return out.text();
}

inline std::string gmshElementsText(const GmshModel& model, const GmshEncoding& encoding) {
  GmshWriter out(encoding);
  std::int64_t total = 0;
  for (const auto& block : model.elements) total += static_cast<std::int64_t>(block.elements.size());
  out.size(static_cast<std::int64_t>(model.elements.size())).size(total);
  if (!encoding.version40) out.size(1).size(2000000000);
  out.end();
  for (const auto& block : model.elements) {
    out.owner(block.dimension, block.entity).integer(block.type);
    out.size(static_cast<std::int64_t>(block.elements.size())).end();
    for (const auto& element : block.elements) {
      for (const std::int64_t tag : element) out.tag(tag);
      out.end();
    }
  }
  return out.text();
}

inline std::string gmshLinksText(const GmshModel& model, const GmshEncoding& encoding) {
  GmshWriter out(encoding);
  const auto count = static_cast<std::int64_t>(model.links.size());
  encoding.version40 ? out.integer(count) : out.size(count);
  out.end();
  for (const auto& link : model.links) {
    out.integer(link.dimension).integer(link.entity).integer(link.master).end();
    if (!encoding.version40)
      out.size(link.affine ? 16 : 0);
    else if (link.affine)
      encoding.binary ? out.size(-1) : out.raw("Affine ");
    for (int k = 0; link.affine && k < 16; ++k) out.real(k);
    if (!encoding.version40 || link.affine) out.end();
    out.size(static_cast<std::int64_t>(link.pairs.size())).end();
    for (const auto& [node, master] : link.pairs) out.tag(node).tag(master).end();
  }
  return out.text();
}

// Of version 2 the count on a line, then tag and place of each.
inline std::string gmshNodesText2(const GmshModel& model, const GmshEncoding& encoding) {
  std::size_t total = 0;
  for (const auto& block : model.nodes) total += block.nodes.size();
  GmshWriter out(encoding);
  out.raw(fmt::format("{}\n", total));
  for (const auto& block : model.nodes)
    for (const auto& [tag, place] : block.nodes) {
      out.tag(tag);
      for (const double x : place) out.real(x);
      out.end();
    }
  return out.text();
}

// An element of several groups stands there once for each; behind its group and its entity one of its partitions.
inline std::string gmshElementsText2(const GmshModel& model, const GmshEncoding& encoding) {
  std::size_t total = 0;
  GmshWriter out(encoding);
  for (const auto& block : model.elements) {
    std::vector<int> groups;
    for (const auto& entity : model.entities)
      if (entity.dimension == block.dimension && entity.tag == block.entity) groups = entity.groups;
    if (groups.empty()) groups.push_back(0);
    // Elements of one group may share a header.
    const bool isShared = groups.size() == 1;
    if (encoding.binary && isShared)
      out.integer(block.type).integer(static_cast<std::int64_t>(block.elements.size())).integer(4);
    for (const auto& element : block.elements)
      for (const int group : groups) {
        ++total;
        if (encoding.binary && !isShared) out.integer(block.type).integer(1).integer(4);
        out.tag(element[0]);
        if (!encoding.binary) out.integer(block.type).integer(4);
        out.integer(group).integer(block.entity).integer(1).integer(3);
        for (std::size_t k = 1; k < element.size(); ++k) out.tag(element[k]);
        out.end();
      }
  }
  return fmt::format("{}\n", total) + out.text();
}

inline std::string gmshText(const GmshModel& model, const GmshEncoding& encoding) {
  std::string text =
      fmt::format("$MeshFormat\n{} {} {}\n", encoding.version(), encoding.binary ? 1 : 0, encoding.sizeBytes);
  if (encoding.binary) text += GmshWriter(encoding).integer(1).raw("\n").text();
  text += "$EndMeshFormat\n";
  if (!model.names.empty()) {
    text += fmt::format("$PhysicalNames\n{}\n", model.names.size());
    for (const std::string& line : model.names) text += line + "\n";
    text += "$EndPhysicalNames\n";
  }
  const auto section = [&](const std::string& name, const std::string& content) {
    text += "$" + name + "\n" + content + (encoding.binary ? "\n" : "") + "$End" + name + "\n";
  };
  section("Comments", "what $EndNodes and $EndComment are here\n$EndComment\n");
  if (encoding.version2) {
    section("Nodes", gmshNodesText2(model, encoding));
    section("Elements", gmshElementsText2(model, encoding));
    // Text in both encodings, as that of version 4.0.
    if (!model.links.empty()) text += "$Periodic\n" + gmshLinksText(model, {true, false, 8}) + "$EndPeriodic\n";
    return text;
  }
  if (!model.entities.empty()) section("Entities", gmshEntitiesText(model, encoding));
  section("Nodes", gmshNodesText(model, encoding));
  section("Elements", gmshElementsText(model, encoding));
  if (!model.links.empty()) section("Periodic", gmshLinksText(model, encoding));
  return text;
}

}  // namespace lampblack::test
