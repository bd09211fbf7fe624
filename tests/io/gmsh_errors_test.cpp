// What is wrong with a mesh file is said on all ranks alike, with its place and what to do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <filesystem>
#include <fstream>

#include "core/errors.hpp"
#include "io/gmsh_reader.hpp"
#include "tests/every_module.hpp"
#include "tests/io/gmsh_model.hpp"
#include "tests/messages.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::io {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class GmshErrors : public ::testing::Test {
 protected:
  std::string refusal(const std::string& text) {
    const std::filesystem::path file = scratch_.path() / "mesh.msh";
    MPI_Barrier(MPI_COMM_WORLD);
    if (test::worldRank() == 0) std::ofstream(file, std::ios::binary) << text;
    MPI_Barrier(MPI_COMM_WORLD);
    return test::messageOf<InputError>([&] {
      try {
        readGmsh(MPI_COMM_WORLD, file, 1.0, 5);
      } catch (const InputError& error) {
        EXPECT_TRUE(isCollective(error));
        throw;
      }
    });
  }
  std::string refusal(const test::GmshModel& model, const test::GmshEncoding& encoding = {}) {
    return refusal(gmshText(model, encoding));
  }
  // The text of a sound mesh with one piece replaced.
  std::string refusalOf(const std::string& piece, const std::string& by) {
    std::string text = gmshText(sound_, {});
    const std::size_t at = text.find(piece);
    EXPECT_NE(at, std::string::npos) << piece;
    return refusal(text.replace(at, piece.size(), by));
  }
  test::GmshModel sound_ = {{R"(1 11 "wall")", R"(1 12 "open")"},
                            {{1, 1, {11}}, {2, 1, {}}},
                            {{2, 1, false, {{1, {0, 0, 0}}, {2, {3, 0, 0}}, {3, {0, 1, 0}}, {4, {3, 1, 0}}}}},
                            {{1, 1, 1, {{7, 1, 2}}}, {2, 1, 2, {{8, 1, 2, 3}, {9, 2, 4, 3}}}},
                            {{1, 1, 1, false, {{2, 1}}}}};
  test::SharedScratchFolder scratch_;
};

TEST_F(GmshErrors, OtherFilesAreNamedForWhatTheyAre) {
  EXPECT_EQ(refusal(sound_), "");
  EXPECT_THAT(refusal(gmshText(sound_, {}) + "x"), HasSubstr("found 'x'"));  // a byte alone is not the end
  EXPECT_THAT(test::messageOf<InputError>([&] { readGmsh(MPI_COMM_WORLD, scratch_.path() / "missing.msh", 1.0); }),
              HasSubstr("missing.msh: there is no such file"));
  EXPECT_THAT(test::messageOf<InputError>([&] { readGmsh(MPI_COMM_WORLD, scratch_.path(), 1.0); }),
              HasSubstr("this is no regular file"));
  EXPECT_THAT(refusal(""), HasSubstr("mesh.msh: the file is empty"));
  EXPECT_THAT(refusal("solid mesh\n"),
              HasSubstr("line 1: this is no mesh file of Gmsh: expected $MeshFormat, found 'solid'"));
  EXPECT_THAT(refusal("$NOD\n8\n"), HasSubstr("this is a mesh of version 1; save it"));
  EXPECT_THAT(
      refusal("$MeshFormat\n3 0 8\n$EndMeshFormat\n"),
      AllOf(HasSubstr("mesh.msh, line 2, section $MeshFormat: this is a mesh of version 3, which is not read; save it "
                      "from Gmsh as version 4.1 or 2.2"),
            HasSubstr("Mesh.MshFileVersion = 4.1")));
  EXPECT_THAT(refusal("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$ParametricNodes\n1\n"),
              HasSubstr("Mesh.SaveParametric = 0"));
  EXPECT_THAT(refusal(std::string("$MeshFormat\n2.2 1 8\n\0\0\0\1\n$EndMeshFormat\n", 40)), HasSubstr("big endian"));
  EXPECT_THAT(refusal("$MeshFormat\n5 0 8\n"), HasSubstr("version 5, newer than those that are read; save"));
  EXPECT_THAT(refusal("$MeshFormat\n4.1 2 8\n"), HasSubstr("0 for text or 1 for binary, found 2"));
  EXPECT_THAT(refusal("$MeshFormat\n4.1 1 3\n"), HasSubstr("expected the size of data, 4 or 8 bytes, found 3"));
  EXPECT_THAT(refusal("$MeshFormat\n4 1 4\n"), HasSubstr("expected the size of data, 8 bytes, found 4"));
  EXPECT_THAT(refusal(std::string("$MeshFormat\n4.1 1 8\n\0\0\0\1\n$EndMeshFormat\n", 40)),
              AllOf(HasSubstr("byte 20"), HasSubstr("big endian"), HasSubstr("Mesh.Binary = 0")));
  EXPECT_THAT(refusal(std::string("$MeshFormat\n4.1 1 8\n\r\n\1\0\n$EndMeshFormat\n", 40)),
              HasSubstr("copied as if it were text"));
}

TEST_F(GmshErrors, ATruncatedFileIsSaidToBe) {
  for (const test::GmshEncoding& encoding : test::gmshEncodings()) {
    const std::string text = gmshText(sound_, encoding);
    // The last cut that matters is within the last line: its end need not be there.
    for (std::size_t length = 0; length + 1 < text.size(); length += 23) {
      const std::string message = refusal(text.substr(0, length));
      if (text.size() - length > 80) {
        EXPECT_THAT(message, HasSubstr("mesh.msh")) << length;
      }
      EXPECT_THAT(message, ::testing::Not(HasSubstr("other: "))) << length;
    }
  }
  const std::string text = gmshText(sound_, {});
  EXPECT_THAT(refusal(text.substr(0, text.find("3 1 0"))),
              HasSubstr("section $Nodes: the file ends where a coordinate of a node is expected; it was cut off"));
  EXPECT_THAT(refusal(text.substr(0, text.find("$Elements"))), HasSubstr("the file has no section $Elements"));
  EXPECT_THAT(refusal(text.substr(0, text.find("$Nodes"))), HasSubstr("the file has no section $Nodes"));
  EXPECT_THAT(refusal(text.substr(0, text.find("$EndComments"))),
              HasSubstr("the file ends where $EndComments is expected"));
  EXPECT_THAT(refusal(text.substr(0, text.find("$EndPeriodic"))),
              HasSubstr("the file ends where $EndPeriodic is expected"));
}

TEST_F(GmshErrors, ElementsThatAreNotReadAreNamed) {
  test::GmshModel model = sound_;
  model.elements.push_back({2, 1, 140, {{10, 1, 2, 3, 4, 2, 3}}});
  for (const test::GmshEncoding& encoding : test::gmshEncodings())
    EXPECT_THAT(refusal(model, encoding),
                AllOf(HasSubstr("elements of type 140 are not read"), HasSubstr("set Mesh.ElementOrder = 1"),
                      HasSubstr(encoding.binary ? "byte " : "line ")));
  model.elements.back().type = 4;
  EXPECT_THAT(refusal(model), HasSubstr("a surface cannot have elements of type 4"));
}

TEST_F(GmshErrors, CountsThatCannotBeAreRefused) {
  const std::string head = "$Nodes\n1 4 1 2000000000 \n2 1 0 4 \n";
  EXPECT_THAT(refusalOf(head, "$Nodes\n1 900000000000000000 1 4 \n2 1 0 4 \n"),
              HasSubstr("the number of nodes is 900000000000000000, more than the"));
  EXPECT_THAT(refusalOf(head, "$Nodes\n1 60 1 4 \n2 1 0 60 \n"), HasSubstr("the number of nodes is 60, more than the"));
  EXPECT_THAT(refusalOf(head, "$Nodes\n1 -4 1 4 \n2 1 0 4 \n"),
              HasSubstr("expected the number of nodes, 0 or more, found -4"));
  EXPECT_THAT(refusalOf(head, "$Nodes\n1 4 1 4 \n2 1 0 5 \n"), HasSubstr("more nodes than the 4"));
  EXPECT_THAT(refusalOf(head, "$Nodes\n1 5 1 4 \n2 1 0 4 \n"), HasSubstr("announces 5 nodes, its blocks have 4"));
  EXPECT_THAT(refusalOf(head, "$Nodes\n1 4 1 4 \n2 1 0 3 \n"),
              HasSubstr("section $Nodes: the section announces 4 nodes, its blocks have 3"));
  EXPECT_THAT(refusalOf("\n$EndNodes", "\n3 $EndNodes"), HasSubstr("section $Nodes: expected $EndNodes, found '3'"));
  EXPECT_THAT(refusalOf(head, "$Nodes\n1 4 1 4 \n4 1 0 4 \n"),
              HasSubstr("the dimension of an entity, 0 to 3, found 4"));
  const std::string elements = "$Elements\n2 3 1 2000000000 \n1 1 1 1 \n";
  EXPECT_THAT(refusalOf(elements, "$Elements\n2 1000000 1 9 \n1 1 1 1 \n"),
              HasSubstr("the number of elements is 1000000, more than the"));
  EXPECT_THAT(refusalOf(elements, "$Elements\n2 2 1 9 \n1 1 1 1 \n"), HasSubstr("more elements than the 2"));
  EXPECT_THAT(refusalOf(elements, "$Elements\n2 4 1 9 \n1 1 1 1 \n"),
              HasSubstr("announces 4 elements, its blocks have 3"));
  EXPECT_THAT(refusalOf(elements, "$Elements\n2 3 1 9 \n1 1 99999999999 1 \n"),
              HasSubstr("99999999999, which is too large"));
  EXPECT_THAT(refusalOf("$Periodic\n1", "$Periodic\n-1"),
              HasSubstr("the number of periodic links, 0 or more, found -1"));
}

TEST_F(GmshErrors, CountsOfVersionTwoThatCannotBeAreRefused) {
  const test::GmshEncoding text2{false, false, 8, true}, binary2{false, true, 8, true};
  const auto with = [&](const test::GmshEncoding& encoding, const std::string& piece, const std::string& by) {
    std::string text = gmshText(sound_, encoding);
    const std::size_t at = text.find(piece);
    EXPECT_NE(at, std::string::npos) << piece;
    return refusal(text.replace(at, piece.size(), by));
  };
  for (const test::GmshEncoding& encoding : {text2, binary2}) {
    EXPECT_THAT(with(encoding, "$Nodes\n4\n", "$Nodes\n60\n"), HasSubstr("the number of nodes is 60, more than the"));
    EXPECT_THAT(with(encoding, "$Nodes\n4\n", "$Nodes\n-4\n"), HasSubstr("0 or more, found -4"));
    EXPECT_THAT(with(encoding, "$Nodes\n4\n", "$Nodes\n3\n"), HasSubstr("expected $EndNodes"));
    EXPECT_THAT(with(encoding, "$Elements\n3\n", "$Elements\n2\n"),
                HasSubstr(encoding.binary ? "more elements than the 2" : "expected $EndElements"));
    EXPECT_THAT(with(encoding, "$Elements\n3\n", "$Elements\n1000000\n"),
                HasSubstr("the number of elements is 1000000, more than the"));
  }
  std::string header = test::GmshWriter(binary2).integer(1).integer(1).integer(4).text();
  EXPECT_THAT(with(binary2, header, test::GmshWriter(binary2).integer(1).integer(0).integer(4).text()),
              HasSubstr("found 0 elements with 4 tags"));
  test::GmshModel model = sound_;
  model.entities[0].groups = {11, 12};
  for (const test::GmshEncoding& encoding : {text2, binary2})
    EXPECT_THAT(refusal(model, encoding), HasSubstr("the element 7 is in two physical groups, 'wall' and 'open'"));
}

TEST_F(GmshErrors, WhatCannotBeReadIsSaidWithItsPlace) {
  // $MeshFormat, $PhysicalNames, $Comments and $Entities take 17 lines, the counts, the block and its tags seven.
  EXPECT_THAT(refusalOf("3 0 0", "3 x0 0"),
              HasSubstr("mesh.msh, line 26, section $Nodes: expected a coordinate of a node, a number, found 'x0'"));
  EXPECT_THAT(refusalOf("3 0 0", "3 nan 0"), HasSubstr("expected a coordinate of a node, found nan"));
  EXPECT_THAT(refusalOf("3 0 0", "3 1e999 0"), HasSubstr("expected a coordinate of a node, found inf"));
  EXPECT_THAT(refusalOf("3 0 0", std::string(5000, 'x')), HasSubstr("which is too long for a word"));
  EXPECT_THAT(refusalOf("7 1 2 \n", "7 1.5 2 \n"),
              HasSubstr("expected the tag of a node, a whole number, found '1.5'"));
  EXPECT_THAT(refusalOf("7 1 2 \n", "7 0 2 \n"), HasSubstr("expected the tag of a node, 1 or more, found 0"));
  EXPECT_THAT(refusalOf("7 1 2 \n", "7 2 2 \n"), HasSubstr("the element 7 has the node 2 twice"));
  EXPECT_THAT(refusalOf("\"wall\"", "wall"),
              HasSubstr("line 6, section $PhysicalNames: expected the name of a physical group"));
  EXPECT_THAT(refusalOf("1 11 \"", "4 11 \""), HasSubstr("the dimension of a physical group, 0 to 3, found 4"));
  EXPECT_THAT(refusalOf("1 11 2 1 -2", "1 0 2 1 -2"), HasSubstr("expected the tag of a physical group, found 0"));
  EXPECT_THAT(refusalOf("$Comments", "Comments"), HasSubstr("expected a section, such as $Nodes, found 'Comments'"));
  EXPECT_THAT(refusalOf("$Comments", "$EndComments"), HasSubstr("expected a section, such as $Nodes"));
  EXPECT_THAT(refusalOf("$Comments", "$PartitionedEntities"), HasSubstr("this mesh is partitioned"));
  EXPECT_THAT(refusalOf("$Comments", "$MeshFormat"), HasSubstr("two files in one are not read"));
  EXPECT_THAT(refusalOf("$Elements\n2", "$Nodes\n2"), HasSubstr("two meshes in one file are not read"));
  const std::string entities = "$Entities\n0 0 0 0\n$EndEntities\n";
  EXPECT_THAT(refusal("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Elements\n0 0 0 0\n$EndElements\n" + entities),
              HasSubstr("this section stands behind $Elements"));
  EXPECT_THAT(refusalOf("1 1 1 1 \n7", "1 3 1 1 \n7"),
              HasSubstr("belongs to the curve 3, which is not in the section $Entities"));
}

TEST_F(GmshErrors, NodesThatAreNotThereAreNamed) {
  for (const test::GmshEncoding& encoding : test::gmshEncodings()) {
    test::GmshModel model = sound_;
    model.elements[1].elements[1][2] = 44;
    EXPECT_THAT(refusal(model, encoding),
                HasSubstr("mesh.msh: section $Elements: the element 9 names the node 44, which is not"));
    model = sound_;
    model.elements[0].elements[0][1] = 45;
    EXPECT_THAT(refusal(model, encoding),
                HasSubstr("the element 7 names the node 45, which is not in the section $Nodes"));
    model = sound_;
    model.links[0].pairs[0].second = 46;
    EXPECT_THAT(refusal(model, encoding), HasSubstr("section $Periodic names the node 46, which is not"));
    model = sound_;
    model.nodes[0].nodes[2].first = 2;
    EXPECT_THAT(refusal(model, encoding), HasSubstr("section $Nodes: two nodes have the tag 2"));
  }
}

TEST_F(GmshErrors, AMeshThatCannotBeComputedOnIsRefused) {
  test::GmshModel model = sound_;
  model.elements.pop_back();
  EXPECT_THAT(refusal(model), HasSubstr("mesh.msh: the mesh has no cells: no triangles"));
  model = sound_;
  model.nodes[0].nodes[3].second[2] = 0.5;
  EXPECT_THAT(refusal(model), HasSubstr("do not lie in a plane z = constant: z goes from 0 m to 0.5 m"));
  model.nodes[0].nodes[3].second[2] = 1e-11;  // rounding
  EXPECT_EQ(refusal(model), "");
  model = sound_;
  model.entities[0].groups = {11, 12};
  EXPECT_THAT(refusal(model), HasSubstr("the curve 1 is in two physical groups, 'wall' and 'open'"));
  model = sound_;
  model.nodes[0].nodes[3].second = {6, -1, 0};  // on the line through the others
  EXPECT_THAT(
      refusal(model),
      HasSubstr("section $Elements: 1 cell is folded or flat, which no order of corners mends; the first is cell 1, a "
                "triangle (element 9 of the file) with a corner at (3, 0, 0) m; mesh again"));
  model = sound_;
  model.elements[1] = {2, 1, 3, {{8, 1, 4, 2, 3}, {9, 1, 4, 2, 3}}};
  EXPECT_THAT(refusal(model),
              HasSubstr("2 cells are folded or flat, which no order of corners mends; the first is cell 0, a "
                        "quadrilateral (element 8 of the file)"));
}

}  // namespace
}  // namespace lampblack::io
