// A specification expands to the same cases under the same ids, however it is written and cut into shards.
#include "sweep/cases.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "fake_server.h"
#include "sundial/method_choice.h"

namespace sundial::sweep {
namespace {

namespace fs = std::filesystem;

v1::SweepSpec specOf(const std::string& text) {
  v1::SweepSpec spec;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &spec)) << text;
  return spec;
}

std::vector<Case> casesOf(const std::string& text, const fs::path& folder = ".") {
  const auto cases = expand(specOf(text), folder);
  EXPECT_TRUE(cases) << cases.error().message;
  return cases ? cases->list : std::vector<Case>{};
}

std::string written(const Case& one) {
  return one.scene + " " + std::to_string(one.request.width()) + " " + one.viewName + " " + one.lightName +
         " " + client::methodLabel(one.request.methods(0));
}

std::set<std::string> idsOf(const std::vector<Case>& cases) {
  std::set<std::string> ids;
  for (const Case& one : cases) ids.insert(one.id);
  return ids;
}

constexpr const char* kGroup = R"(group {
  scene: ["builtin:a", "builtin:b"]
  size { width: 8 height: 8 } size { width: 16 height: 8 }
  view { name: "v" } view { name: "w" }
  light { name: "l" } light { name: "m" }
  method { name: "sm" parameter { key: "texels" value: ["1", "2"] } parameter { key: "bias" value: ["3", "4"] } }
  method { name: "rt" }
})";

TEST(SweepCases, ComeInTheDocumentedOrder) {
  const auto cases = casesOf(kGroup);
  ASSERT_EQ(cases.size(), 2u * 2 * 2 * 2 * 5);
  const char* first[] = {"builtin:a 8 v l sm,bias=3,texels=1",
                         "builtin:a 8 v l sm,bias=4,texels=1",
                         "builtin:a 8 v l sm,bias=3,texels=2",
                         "builtin:a 8 v l sm,bias=4,texels=2",
                         "builtin:a 8 v l rt",
                         "builtin:a 8 v m sm,bias=3,texels=1"};
  for (std::size_t i = 0; i < std::size(first); ++i) EXPECT_EQ(written(cases[i]), first[i]);
  EXPECT_EQ(written(cases[10]), "builtin:a 8 w l sm,bias=3,texels=1");
  EXPECT_EQ(written(cases[20]), "builtin:a 16 v l sm,bias=3,texels=1");
  EXPECT_EQ(written(cases[40]), "builtin:b 8 v l sm,bias=3,texels=1");
}

TEST(SweepCases, AskForWhatTheSpecificationSays) {
  const auto usual = casesOf(R"(group { scene: "builtin:a" method { name: "sm" } })");
  ASSERT_EQ(usual.size(), 1u);
  const v1::RenderRequest& request = usual[0].request;
  EXPECT_EQ(request.width(), 1024u);
  EXPECT_EQ(request.height(), 1024u);
  EXPECT_EQ(request.view_choice_case(), v1::RenderRequest::VIEW_CHOICE_NOT_SET);
  EXPECT_EQ(request.light_choice_case(), v1::RenderRequest::LIGHT_CHOICE_NOT_SET);
  EXPECT_EQ(client::methodLabel(request.baseline()), "sm,texels=2048");
  EXPECT_EQ(request.repetitions(), 5u);
  EXPECT_EQ(request.max_repetitions(), 25u);
  EXPECT_EQ(request.quartile_target(), 0.1);
  EXPECT_TRUE(request.measures());
  EXPECT_TRUE(request.images().empty());

  const auto other = casesOf(R"(baseline: "dv" repetitions: 40 quartile_target: 0
    group { scene: "builtin:a" method { name: "sm" } view { view { eye { x: 1 } target { y: 2 } } } })");
  EXPECT_EQ(other[0].request.baseline().name(), "dv");
  EXPECT_EQ(other[0].request.max_repetitions(), 40u);
  EXPECT_EQ(other[0].request.quartile_target(), 0);
  EXPECT_EQ(other[0].request.view().up().y(), 1);
  EXPECT_EQ(other[0].request.view().vertical_fov_degrees(), 60);
}

// Ids are written into files that outlive a version: this one may never change.
TEST(SweepCases, AnIdStaysWhatItIs) {
  const auto cases =
      casesOf(R"(group { scene: "builtin:grid" size { width: 64 height: 48 } view { name: "main" }
    light { name: "sun" } method { name: "sm" parameter { key: "texels" value: "512" } } })");
  EXPECT_EQ(cases[0].id, "0d84d42464a4c4ab");
}

TEST(SweepCases, AnIdAlongAPathStaysWhatItIs) {
  const auto cases =
      casesOf(R"(group { scene: "builtin:grid" size { width: 64 height: 48 } path { name: "orbit" }
    light { name: "sun" } method { name: "sm" } frames: 6 points: 500 })");
  EXPECT_EQ(cases[0].id, "1d1a07a4751f0f28");
}

TEST(SweepCases, WhatMovesComesAfterWhatStands) {
  const auto cases = casesOf(R"(group { scene: "a" view { name: "v" } path { name: "p" } light { name: "l" }
    light_path { name: "q" } method { name: "sm" } })");
  ASSERT_EQ(cases.size(), 4u);
  EXPECT_FALSE(cases[0].along);
  const std::pair<const char*, const char*> names[] = {{"", ""}, {"", "q"}, {"p", ""}, {"p", "q"}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(cases[i].pathName, names[i].first);
    EXPECT_EQ(cases[i].lightPathName, names[i].second);
  }
  EXPECT_EQ(cases[1].along->view_name(), "v");
  EXPECT_EQ(cases[1].along->light_path_name(), "q");
  EXPECT_EQ(cases[2].along->path_name(), "p");
  EXPECT_EQ(cases[2].along->light_name(), "l");
  EXPECT_EQ(cases[3].along->light_path_name(), "q");
  EXPECT_EQ(cases[2].request.view_choice_case(), v1::RenderRequest::VIEW_CHOICE_NOT_SET);
  EXPECT_EQ(cases[2].request.light_name(), "l");
  EXPECT_EQ(cases[3].along->frames(), 0u);  // as many as the path has
  EXPECT_EQ(cases[3].along->points(), 4096u);
  EXPECT_EQ(cases[3].along->seed(), 1u);
  EXPECT_EQ(cases[3].along->methods(0).name(), "sm");
  // Paths alone bring no still case.
  EXPECT_EQ(casesOf(R"(group { scene: "a" path { name: "p" } method { name: "sm" } })").size(), 1u);
}

TEST(SweepCases, PathsAreReadFromFilesAndWrittenInPlace) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "turn.textproto") << "keys { eye { x: 1 } } keys { eye { x: 2 } } frames: 7";
  std::ofstream(folder.path() / "day.textproto") << "keys { sun { direction { y: -1 } } } frames: 9";
  const auto read = casesOf(R"(group { scene: "a" method { name: "sm" } path { file: "turn.textproto" }
    light_path { name: "noon" file: "day.textproto" } })",
                            folder.path());
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].pathName, "turn");
  EXPECT_EQ(read[0].lightPathName, "noon");
  EXPECT_EQ(read[0].along->path().keys(1).vertical_fov_degrees(), 60);
  EXPECT_EQ(read[0].along->path().keys(1).up().y(), 1);
  EXPECT_EQ(read[0].along->frames(), 7u);  // the camera's go first
  const auto inPlace = casesOf(R"(group { scene: "a" method { name: "sm" } frames: 7
    path { name: "x" keys { keys { eye { x: 1 } up { y: 1 } } keys { eye { x: 2 } vertical_fov_degrees: 60 } } }
    light_path { name: "y" keys { keys { sun { direction { y: -1 } } } } } })");
  EXPECT_EQ(idsOf(inPlace), idsOf(read));  // the same, however it is written
}

TEST(SweepCases, IdsDontDependOnTheOrder) {
  const auto turned = casesOf(R"(repetitions: 7 baseline: "dv" group {
    method { name: "rt" }
    method { name: "sm" parameter { key: "bias" value: ["4", "3"] } parameter { key: "texels" value: ["2", "1"] } }
    light { name: "m" } light { name: "l" }
    view { name: "w" } view { name: "v" }
    size { width: 16 height: 8 } size { width: 8 height: 8 }
    scene: ["builtin:b", "builtin:a"] })");
  EXPECT_EQ(idsOf(turned), idsOf(casesOf(kGroup)));
}

TEST(SweepCases, EverythingOfACaseTellsItsIdApart) {
  const std::vector<std::string> groups = {
      R"(scene: "a" method { name: "sm" })",
      R"(scene: "b" method { name: "sm" })",
      R"(scene: "a" method { name: "dv" })",
      R"(scene: "a" method { name: "sm" parameter { key: "k" value: ["1", "2"] } })",
      R"(scene: "a" method { name: "sm" parameter { key: "l" value: "1" } })",
      R"(scene: "a" method { name: "sm" } size { width: 9 height: 8 } size { width: 8 height: 9 })",
      R"(scene: "a" method { name: "sm" } view { name: "v" } light { name: "v" })",
      R"(scene: "a" method { name: "sm" } view { name: "v" })",
      R"(scene: "a" method { name: "sm" } light { name: "v" })",
      R"(scene: "a" method { name: "sm" } view { name: "v" view { eye { x: 1 } } }
         view { name: "v" view { target { x: 1 } } } view { view { eye { x: 1.0000000000000002 } } }
         view { view { eye { x: 1 } vertical_fov_degrees: 61 } } view { view { eye { x: 1 } up { z: 1 } } })",
      R"(scene: "a" method { name: "sm" } path { name: "v" } path { name: "w" })",
      R"(scene: "a" method { name: "sm" } light_path { name: "v" })",
      R"(scene: "a" method { name: "sm" } path { name: "v" } light { name: "v" } light_path { name: "v" })",
      R"(scene: "a" method { name: "sm" } path { name: "v" } frames: 5)",
      R"(scene: "a" method { name: "sm" } path { name: "v" } points: 5)",
      R"(scene: "a" method { name: "sm" } path { name: "v" } seed: 5)",
      R"(scene: "a" method { name: "sm" } frames: 5 path { name: "v" keys { keys { eye { x: 1 } } } }
         path { name: "v" keys { keys { eye { x: 1 } } keys { eye { x: 1 } } } })",
      R"(scene: "a" method { name: "sm" } light { light { sun { direction { x: 1 } } } }
         light { light { point { position { x: 1 } } } } light { light { spot { eye { x: 1 } } } }
         light { light { spot { target { x: 1 } } } } light { light { spot { target { x: 1 } cone_degrees: 9 } } })"};
  std::string all;
  std::size_t count = 0;
  for (const std::string& group : groups) {
    count += casesOf("group {" + group + "}").size();
    all += "group {" + group + "}";
  }
  EXPECT_EQ(count, 31u);
  EXPECT_EQ(casesOf(all).size(), count);
}

TEST(SweepCases, DuplicatesCollapse) {
  EXPECT_EQ(casesOf(std::string(kGroup) + kGroup).size(), casesOf(kGroup).size());
  // A name of an explicit view is what reports call it, no more; up and the field of view have their
  // defaults.
  EXPECT_EQ(casesOf(R"(group { scene: "a" method { name: "sm" parameter { key: "k" value: ["1", "1"] } }
    view { name: "x" view { eye { x: 1 } } } view { view { eye { x: 1 } up { y: 1 } vertical_fov_degrees: 60 } } })")
                .size(),
            1u);
}

TEST(SweepCases, ShardsAreDisjointAndWhole) {
  const auto cases = casesOf(kGroup);
  for (const unsigned count : {1u, 2u, 3u, 7u, 200u}) {
    std::multiset<std::string> seen;
    for (unsigned index = 1; index <= count; ++index)
      for (const Case& one : cases)
        if (Shard{index, count}.has(one)) seen.insert(one.id);
    const auto all = idsOf(cases);
    EXPECT_EQ(seen, (std::multiset<std::string>(all.begin(), all.end()))) << count;
  }
}

TEST(SweepCases, LocalScenesAreNamedByTheirContent) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "x.gltf") << "{}";
  std::ofstream(folder.path() / "same.gltf") << "{}";
  std::ofstream(folder.path() / "other.gltf") << "{ }";
  const auto cases =
      expand(specOf(R"(group { scene: ["./x.gltf", "./same.gltf", "./other.gltf"] method { name: "sm" } })"),
             folder.path());
  ASSERT_TRUE(cases) << cases.error().message;
  ASSERT_EQ(cases->list.size(), 2u);
  EXPECT_EQ(cases->list[0].scene, "./x.gltf");
  EXPECT_TRUE(cases->list[0].request.scene().starts_with("digest:"));
  EXPECT_EQ(cases->files.at(cases->list[1].request.scene()).files[0].uri, "other.gltf");
}

TEST(SweepCases, RefuseWhatCanNeverBe) {
  const std::pair<const char*, const char*> bad[] = {
      {"", "no group"},
      {R"(group { method { name: "sm" } })", "group 1: it names no scene"},
      {R"(group { scene: "a" method { name: "sm" } } group { scene: "a" })", "group 2: it names no method"},
      {R"(group { scene: "a" method {} })", "a method has no name"},
      {R"(group { scene: "a" method { name: "sm" parameter { key: "k" } } })", "at least one value"},
      {R"(group { scene: "a" method { name: "sm" parameter { value: "1" } } })", "a key"},
      {R"(group { scene: "a" method { name: "sm" parameter { key: "k" value: "1" } parameter { key: "k" value: "2" } } })",
       "'k' comes twice"},
      {R"(group { scene: "a" method { name: "sm" } size { width: 8 } })", "size is 8x0"},
      {R"(group { scene: "a" method { name: "sm" } view {} })", "neither a name nor a view"},
      {R"(group { scene: "a" method { name: "sm" } light { light {} } })", "neither a name nor a sun"},
      {R"(group { scene: "a" method { name: "sm" } frames: 5 })", "nothing does"},
      {R"(group { scene: "a" method { name: "sm" } path {} })", "a path has neither"},
      {R"(group { scene: "a" method { name: "sm" } light_path {} })", "a light_path has neither"},
      {R"(group { scene: "a" method { name: "sm" } path { keys { keys {} frames: 5 } } })",
       "a path has neither"},
      {R"(group { scene: "a" method { name: "sm" } path { name: "x" keys { frames: 5 } } })",
       "'x' has 0 keys"},
      {R"(group { scene: "a" method { name: "sm" } path { name: "x" keys { keys {} } } })",
       "'x' has 0 frames"},
      {R"(group { scene: "a" method { name: "sm" } path { name: "x" keys { keys {} frames: 2001 } } })",
       "2001 frames"},
      {R"(group { scene: "a" method { name: "sm" } path { name: "x" keys {} file: "y" } })",
       "give one of them"},
      {R"(group { scene: "a" method { name: "sm" } path { file: "gone.textproto" } })",
       "path: can't read ./gone.textproto"},
      {R"(group { scene: "a" method { name: "sm" } path { name: "x" } frames: 2001 })", "frames is 2001"},
      {R"(group { scene: "a" method { name: "sm" } path { name: "x" } points: 65537 })", "points is 65537"},
      {R"(group { scene: "./gone.glb" method { name: "sm" } })", "gone.glb"},
      {R"(baseline: "sm,x" group { scene: "a" method { name: "sm" } })", "baseline: "},
      {R"(repetitions: 5 max_repetitions: 4 group { scene: "a" method { name: "sm" } })",
       "max_repetitions is 4"}};
  for (const auto& [text, why] : bad) {
    const auto cases = expand(specOf(text), ".");
    ASSERT_FALSE(cases) << text;
    EXPECT_NE(cases.error().message.find(why), std::string::npos) << text << ": " << cases.error().message;
  }
}

TEST(ReadSpec, SaysWhereItIsWrong) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "s.textproto";
  EXPECT_EQ(readSpec(file).error().code, grpc::NOT_FOUND);
  std::ofstream(file) << "group {\n  scenes: \"builtin:grid\"\n}\n";
  EXPECT_NE(readSpec(file).error().message.find("line 2"), std::string::npos)
      << readSpec(file).error().message;
  EXPECT_NE(readSpec(file).error().message.find("scenes"), std::string::npos);
}

TEST(ReadSpec, ThoseThatAreInstalledAreGood) {
  for (const auto& [name, least] : {std::pair{"small.textproto", 30u}, {"all.textproto", 200u}}) {
    const auto spec = readSpec(fs::path(SUNDIAL_SWEEPS) / name);
    ASSERT_TRUE(spec) << spec.error().message;
    const auto cases = expand(*spec, SUNDIAL_SWEEPS);
    ASSERT_TRUE(cases) << cases.error().message;
    EXPECT_GE(cases->list.size(), least) << name;
  }
}

}  // namespace
}  // namespace sundial::sweep
