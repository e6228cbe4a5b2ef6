// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/model/mesh_file.h"
#include "core/model/primitives.h"
#include "tests/integration/process.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {
namespace {

using Json = nlohmann::json;

std::string homeWith(const std::string& element) {
  return "<apartment id=\"flat\" name=\"flat\" version=\"1\">\n<room id=\"kitchen\" name=\"kitchen\">\n" + element +
         "\n</room>\n</apartment>\n";
}

TEST(ModelShapes, ListsKindsAndDimensions) {
  const ProcessResult kinds = runOikos({"model", "shapes"});
  EXPECT_EQ(kinds.exit_code, 0);
  EXPECT_TRUE(kinds.out.starts_with("cabinet\ndrawer_unit\n")) << kinds.out;
  const ProcessResult rug = runOikos({"model", "shapes", "rug"});
  EXPECT_EQ(rug.out,
            "width_m=\"1.6\"\ndepth_m=\"2.3\"\nheight_m=\"0.012\"\nborder_m=\"0.1\"\nmiddle_rgb=\"#A65E4E\"\nborder_rgb=\"#D9C7A3\"\n");
  const ProcessResult oven = runOikos({"model", "shapes", "oven", "--json"});
  EXPECT_EQ(Json::parse(oven.out)["defaults"]["knob_range_deg"], "270");
  const ProcessResult wrong = runOikos({"model", "shapes", "ovne"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_EQ(wrong.err, "oikos: no shape of kind 'ovne'; did you mean 'oven'?\n");
}

TEST(ModelImport, SaysWhatIsInAFileAndWritesItAsObj) {
  const TemporaryFolder folder;
  const std::string box = (folder.path() / "box.obj").string();
  const std::string copy = (folder.path() / "copy.obj").string();
  model::writeObj(model::makeBox({0.1F, 0.2F, 0.3F}), box);
  const ProcessResult text = runOikos({"model", "import", box, "--out", copy});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_EQ(text.out, box + ": 12 triangles, 0.100 x 0.200 x 0.300 m (x, y, z)\npart box: 12 triangles\nwritten: " + copy + "\n");
  EXPECT_EQ(model::readMesh(copy).mesh_model.triangles.size(), 12U);
  EXPECT_EQ(Json::parse(runOikos({"model", "import", copy, "--json"}).out)["size_m"], Json::array({0.1, 0.2, 0.3}));
}

TEST(ModelImport, AUrdfInPartsAndJoints) {
  const TemporaryFolder folder;
  const std::string urdf = folder.write("chest.urdf", R"(<robot name="chest">
    <link name="body"><visual><geometry><box size="0.5 0.6 0.4"/></geometry></visual></link>
    <link name="lid"><visual><origin xyz="0.25 0 0.01"/><geometry><box size="0.5 0.6 0.02"/></geometry></visual></link>
    <joint name="hinge" type="revolute"><parent link="body"/><child link="lid"/><origin xyz="-0.25 0 0.2"/><axis xyz="0 -1 0"/>
      <limit lower="0" upper="1.5707963267948966" effort="1" velocity="1"/></joint>
  </robot>)");
  const std::string out = (folder.path() / "chest.obj").string();
  const ProcessResult text = runOikos({"model", "import", urdf, "--out", out});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("24 triangles, 0.500 x 0.600 x 0.420 m"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("joint hinge: revolute, body to lid, 0 to 90 deg\n"), std::string::npos) << text.out;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "chest-body.obj"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "chest-lid.obj"));
}

TEST(ModelImport, PrintsAnElementThatAHomeTakes) {
  const TemporaryFolder home;
  const ProcessResult cupboard =
      runOikos({"model", "import", "--shape", "cabinet width_m=0.8 door_count=2", "--id", "cupboard", "--at", "1 2 0 0 0 90"});
  ASSERT_EQ(cupboard.exit_code, 0) << cupboard.err;
  EXPECT_TRUE(cupboard.out.starts_with("<largeArticulatedObject id=\"cupboard\" type=\"cupboard\" pose=\"1 2 0 0 0 90\"")) << cupboard.out;
  EXPECT_NE(cupboard.out.find("<shape kind=\"cabinet\" width_m=\"0.8\" door_count=\"2\"/>"), std::string::npos) << cupboard.out;
  EXPECT_NE(cupboard.out.find("upper_deg=\"110\""), std::string::npos) << cupboard.out;
  EXPECT_NE(cupboard.out.find("<parkingPose pose=\"1.13 0 0 0 0 180\" default=\"true\"/>"), std::string::npos) << cupboard.out;
  const ProcessResult table = runOikos({"model", "import", "--shape", "table", "--id", "desk", "--type", "desk"});
  EXPECT_TRUE(table.out.starts_with("<largeObject id=\"desk\" type=\"desk\"")) << table.out;
  (void)home.write("home.xml", homeWith(cupboard.out + table.out));
  const ProcessResult check = runOikos({"check", home.path().string()});
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_NE(check.out.find("0 errors, 0 warnings"), std::string::npos) << check.out;
}

TEST(ModelImport, ARoomDoorIsADoor) {
  const ProcessResult door = runOikos({"model", "import", "--shape", "room_door", "--id", "bath-door"});
  EXPECT_TRUE(door.out.starts_with("<largeArticulatedObject id=\"bath-door\" type=\"door\"")) << door.out;
}

TEST(ModelImport, ASmallObjectIsPrintedAsOne) {
  const ProcessResult cup =
      runOikos({"model", "import", "--shape", "cup height_m=0.12", "--id", "mug", "--parent", "desk", "--at", "0.1 0.2 0.74 0 0 0"});
  ASSERT_EQ(cup.exit_code, 0) << cup.err;
  EXPECT_TRUE(cup.out.starts_with("<smallObject id=\"mug\" type=\"cup\" parent=\"desk\" relation=\"on\" pose=\"0.1 0.2 0.74 0 0 0\""))
      << cup.out;
  EXPECT_NE(cup.out.find("<graspingPoint pose=\"0 0 0.06 0 0 0\"/>"), std::string::npos) << cup.out;
  EXPECT_EQ(cup.out.find("parkingPose"), std::string::npos) << cup.out;
  const ProcessResult table = runOikos({"model", "import", "--shape", "table", "--id", "desk"});
  const TemporaryFolder home;
  std::string laid = table.out;  // what it carries stands within the table's element
  laid.insert(laid.find("</largeObject>"), cup.out);
  (void)home.write("home.xml", homeWith(laid));
  const ProcessResult check = runOikos({"check", home.path().string()});
  EXPECT_NE(check.out.find("0 errors, 0 warnings"), std::string::npos) << check.out;
  for (const std::string kind : {"bowl", "plate", "bottle", "tin", "jar", "box", "carton", "book"}) {
    const ProcessResult small = runOikos({"model", "import", "--shape", kind, "--id", "it"});
    EXPECT_TRUE(small.out.starts_with("<smallObject id=\"it\"")) << small.out << small.err;
  }
}

TEST(ModelImport, AShapeIsReportedAndWrittenLikeAFile) {
  const TemporaryFolder folder;
  const ProcessResult result = runOikos({"model", "import", "--shape", "drawer_unit drawer_count=2 front_heights_m=0.2 0.4", "--json",
                                         "--out", (folder.path() / "unit.obj").string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json["parts"].size(), 3U);
  EXPECT_EQ(json["joints"][1]["type"], "prismatic");
  EXPECT_EQ(json["written"].size(), 3U);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "unit-drawer_1.obj"));
}

TEST(ModelImport, WhatIsWrongWithTheCommandLineOrTheFile) {
  const auto expectFailure = [](const std::vector<std::string>& arguments, int code, const std::string& message) {
    std::vector<std::string> all = {"model", "import"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const ProcessResult result = runOikos(all);
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
  };
  expectFailure({}, 2, "give either FILE or --shape");
  expectFailure({"a.obj", "--shape", "rug"}, 2, "give either FILE or --shape");
  expectFailure({"a.obj", "--id", "a"}, 2, "--id: only for a --shape");
  expectFailure({"--shape", "rug", "--type", "rug"}, 2, "--id");
  expectFailure({"--shape", "cabnet"}, 2, "--shape: no shape of kind 'cabnet'; did you mean 'cabinet'?");
  expectFailure({"--shape", "rug big"}, 2, "--shape: 'big': must be NAME=VALUE");
  expectFailure({"--shape", "rug width_m=-1"}, 2, "--shape: width_m = -1: must be > 0");
  expectFailure({"--shape", "rug", "--id", "a rug"}, 2, "id");
  expectFailure({"--shape", "rug", "--id", "rug", "--at", "1 2"}, 2, "--at: '1 2': must be");
  expectFailure({"--shape", "rug", "--out", "rug.stl"}, 2, "must end in .obj");
  expectFailure({"/nowhere/a.obj"}, 4, "/nowhere/a.obj");
  const TemporaryFolder folder;
  expectFailure({folder.write("a.xyz", "1 2 3").string()}, 3, "a.xyz");
}

}  // namespace
}  // namespace oikos::test
