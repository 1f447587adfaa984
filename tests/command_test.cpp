// The command as its users meet it: what it prints, what it writes, and with which status it ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "fake_server.h"
#include "process.h"

// After protobuf's headers: it undefines macros of theirs.
#include <OpenImageIO/imageio.h>

namespace sundial::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class CommandTest : public testing::Test {
 protected:
  FakeServer server;
  TemporaryFolder folder;

  Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"--server", server.address()});
    return sundial(arguments);
  }
  Outcome render(std::vector<std::string> more, const std::string& file = "x.png") {
    std::vector<std::string> all{"render", "builtin:discs", "--method", "sm,texels=256",
                                 "--size", "64x48",         "-o",       path(file)};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  bool empty() const { return fs::is_empty(folder.path()); }
};

// A file with the time in it, to the second, would differ afterwards.
void waitForAnotherSecond() {
  const std::time_t now = std::time(nullptr);
  while (std::time(nullptr) == now) std::this_thread::yield();
}

// One line that says what is wrong, nothing on standard output.
void expectFailure(const Outcome& outcome, int status, const std::string& says) {
  EXPECT_EQ(outcome.status, status) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("sundial: ")) << outcome.err;
  EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

TEST_F(CommandTest, EveryCommandHasHelpWithAnExample) {
  for (const char* command : {"scenes", "load", "unload", "methods", "render", "compare", "sweep"}) {
    const Outcome outcome = sundial({command, "--help"});
    EXPECT_EQ(outcome.status, 0) << command;
    EXPECT_NE(outcome.out.find("Example:\n  sundial "), std::string::npos) << command;
  }
  EXPECT_NE(sundial({"--help"}).out.find("Example:"), std::string::npos);
}

TEST_F(CommandTest, RefusesABadCommandLine) {
  expectFailure(sundial({}), 2, "--help");
  expectFailure(run({"paint"}), 2, "there is no 'paint'");
  expectFailure(run({"render", "builtin:discs", "-o", path("x.png")}), 2, "--method");
  expectFailure(render({"--glow"}), 2, "--glow");
  expectFailure(sundial({"--server", "nowhere", "scenes"}), 2, "'nowhere' is no server address");
  expectFailure(sundial({"load", "builtin:discs"}), 2, "load needs a server");
  expectFailure(sundial({"unload", "builtin:discs"}), 2, "unload needs a server");
  expectFailure(run({"unload", "./x.glb"}), 2, "local file");
  expectFailure(run({"--scene-root", "/", "scenes"}), 2, "--scene-root");
  EXPECT_EQ(server.renderings, 0);
}

TEST_F(CommandTest, RefusesBadNumbers) {
  for (const char* size : {"0x0", "0x9", "9", "9x", "x9", "-1x9", "9x9x9", "9.5x9", "99999999999x9"})
    expectFailure(render({"--size", size}), 2, "--size");
  for (const char* eye : {"1,2", "1,2,3,4", "a,2,3", "1,,3", "nan,0,0", "inf,0,0", "1, 2,3"})
    expectFailure(render({"--eye", eye, "--target", "9,9,9"}), 2, "--eye");
  expectFailure(render({"--eye", "1,2,3", "--target", "1,2,3"}), 2, "--target");
  expectFailure(render({"--eye", "0,5,0", "--target", "0,0,0"}), 2, "--up");
  expectFailure(render({"--eye", "0,5,0"}), 2, "--target");
  for (const char* fov : {"0", "180", "-5", "x"})
    expectFailure(render({"--eye", "1,2,3", "--target", "0,0,0", "--fov", fov}), 2, "--fov");
  expectFailure(render({"--view", "a", "--eye", "1,2,3", "--target", "0,0,0"}), 2, "--view");
  expectFailure(render({"--sun", "0,0,0"}), 2, "--sun");
  expectFailure(render({"--spot", "1,2,3,1,2,3,40"}), 2, "--spot");
  expectFailure(render({"--spot", "1,2,3,0,0,0,171"}), 2, "--spot");
  expectFailure(render({"--sun", "1,-1,0", "--point", "0,1,0"}), 2, "--sun");
  expectFailure(render({"--method", "sm,texels"}), 2, "--method");
  expectFailure(run({"compare", "builtin:discs", "--method", "sm,texels"}), 2, "key=value");
  expectFailure(run({"compare", "builtin:discs", "--method", "sm", "--repetitions", "0"}), 2,
                "--repetitions");
  expectFailure(run({"compare", "builtin:discs", "--method", "sm", "--baseline", ","}), 2, "no method");
  EXPECT_EQ(server.renderings, 0);
  EXPECT_TRUE(empty());
}

TEST_F(CommandTest, RefusesOutputsThatCannotBe) {
  expectFailure(render({}, "x.tga"), 2, "x.tga");
  expectFailure(render({}, "x"), 2, ".exr");
  expectFailure(render({}, "gone/x.png"), 2, "gone");
  expectFailure(render({"--aov", "depth"}), 2, "'depth'");
  std::ofstream(folder.path() / "file") << "in the way";
  expectFailure(run({"compare", "builtin:discs", "--method", "sm", "-o", path("file")}), 2, "file");
  EXPECT_EQ(server.renderings, 0);
}

TEST_F(CommandTest, RefusesUnreadableLocalFiles) {
  expectFailure(run({"render", path("gone.glb"), "--method", "sm", "-o", path("x.png")}), 2, "gone.glb");
  expectFailure(run({"load", path("gone.glb")}), 2, "gone.glb");
}

TEST_F(CommandTest, SendsEveryOption) {
  ASSERT_EQ(render({"--eye", "-1,2,3.5", "--target", "0,1,0", "--up", "0,0,1", "--fov", "35", "--spot",
                    "1,2,3,4,5,6,70"})
                .status,
            0);
  const v1::RenderRequest& request = server.lastRequest;
  EXPECT_EQ(request.scene(), "builtin:discs");
  EXPECT_EQ(request.width(), 64u);
  EXPECT_EQ(request.height(), 48u);
  EXPECT_EQ(request.view().eye().x(), -1);
  EXPECT_EQ(request.view().eye().z(), 3.5);
  EXPECT_EQ(request.view().target().y(), 1);
  EXPECT_EQ(request.view().up().z(), 1);
  EXPECT_EQ(request.view().vertical_fov_degrees(), 35);
  EXPECT_EQ(request.light().spot().eye().y(), 2);
  EXPECT_EQ(request.light().spot().target().z(), 6);
  EXPECT_EQ(request.light().spot().cone_degrees(), 70);
  EXPECT_EQ(request.methods(0).parameters().at("texels"), "256");
  EXPECT_FALSE(request.measures());

  ASSERT_EQ(render({"--sun", "-0.5,-1,0.25"}).status, 0);
  EXPECT_EQ(server.lastRequest.light().sun().direction().z(), 0.25);
  EXPECT_EQ(server.lastRequest.view_choice_case(), v1::RenderRequest::VIEW_CHOICE_NOT_SET);
  ASSERT_EQ(render({"--point", "1,2,3"}).status, 0);
  EXPECT_EQ(server.lastRequest.light().point().position().y(), 2);
  ASSERT_EQ(render({"--view", "front", "--light", "lamp"}).status, 0);
  EXPECT_EQ(server.lastRequest.view_name(), "front");
  EXPECT_EQ(server.lastRequest.light_name(), "lamp");

  ASSERT_EQ(run({"compare", "builtin:discs", "--method", "sm", "--method", "dv", "--size", "8x8"}).status, 0);
  EXPECT_EQ(server.lastRequest.methods_size(), 2);
  EXPECT_TRUE(server.lastRequest.measures());
  EXPECT_EQ(server.lastRequest.repetitions(), 5u);
  EXPECT_EQ(server.lastRequest.baseline().name(), "sm");
  EXPECT_EQ(server.lastRequest.baseline().parameters().at("texels"), "2048");
}

TEST_F(CommandTest, AServersRefusalIsOneLineAndLeavesNoFile) {
  expectFailure(run({"load", "builtin:nope"}), 1, "there is builtin:discs");
  server.refusal = {grpc::INVALID_ARGUMENT, "size: 64x48 is over the limit;\n  ask for less"};
  expectFailure(render({}), 1, "over the limit");
  EXPECT_TRUE(empty());
  expectFailure(run({"compare", "builtin:discs", "--method", "sm"}), 1, "over the limit");
  expectFailure(run({"methods", "nope"}), 1, "there are sm, ray-traced");
  expectFailure(sundial({"--server", "unix:" + path("none"), "scenes"}), 1, "no server answers");
}

TEST_F(CommandTest, ADamagedStreamLeavesNoFile) {
  server.tamper = [](const v1::RenderEvent& event) { return !event.has_done(); };
  for (const char* file : {"x.png", "x.exr", "x.jpg"})
    expectFailure(render({"--aov", "all"}, file), 1, "damaged");
  EXPECT_TRUE(empty());
  // A file that was there stays as it was.
  std::ofstream(folder.path() / "x.png") << "old";
  expectFailure(render({}), 1, "damaged");
  EXPECT_EQ(contents(path("x.png")), "old");
}

TEST_F(CommandTest, TheSameRequestWritesTheSameBytes) {
  for (const char* type : {".png", ".exr", ".jpg"}) {
    ASSERT_EQ(render({}, std::string("a") + type).status, 0);
    if (std::string(type) == ".exr") waitForAnotherSecond();
    ASSERT_EQ(render({}, std::string("b") + type).status, 0);
    EXPECT_TRUE(contents(path(std::string("a") + type)) == contents(path(std::string("b") + type))) << type;
  }
}

TEST_F(CommandTest, ExrHoldsEveryChannel) {
  ASSERT_EQ(render({"--aov", "all"}, "x.exr").status, 0);
  const auto input = OIIO::ImageInput::open(path("x.exr"));
  ASSERT_TRUE(input);
  const OIIO::ImageSpec& spec = input->spec();
  std::vector<std::string> names = spec.channelnames;
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"A", "B", "G", "R", "class.I", "id.instance", "id.triangle",
                                             "normal.X", "normal.Y", "normal.Z", "position.X", "position.Y",
                                             "position.Z", "reference.V", "view.I", "visibility.V"}));
  std::vector<std::uint32_t> pixels(64u * 48 * 16);
  ASSERT_TRUE(input->read_image(0, 0, 0, 16, OIIO::TypeUnknown, pixels.data()));
  // The lowest row's middle sees the plane.
  const auto raw = [&](const char* name) {
    const int channel = spec.channelindex(name);
    return pixels[(47u * 64 + 32) * 16 + static_cast<unsigned>(channel)];
  };
  const auto number = [&](const char* name) { return std::bit_cast<float>(raw(name)); };
  for (const std::string& name : names)
    EXPECT_EQ(spec.channelformat(spec.channelindex(name)),
              name.starts_with("id.") || name.ends_with(".I") ? OIIO::TypeUInt32 : OIIO::TypeFloat)
        << name;
  EXPECT_EQ(raw("id.instance"), 3u);
  EXPECT_EQ(raw("id.triangle"), 16777217u);  // which a float can't hold
  EXPECT_EQ(raw("view.I"), 0u);
  EXPECT_EQ(raw("class.I"), 0xffffffffu);  // not a lookup of triangles
  EXPECT_EQ(number("A"), 1);
  EXPECT_EQ(number("normal.Y"), 1);
  EXPECT_EQ(number("position.Y"), 0);
  EXPECT_GT(number("position.X"), 1);
  EXPECT_EQ(number("reference.V"), 1);
  EXPECT_NEAR(number("R"), std::pow((210 / 255.0 + 0.055) / 1.055, 2.4), 1e-5);  // linear
}

TEST_F(CommandTest, PicturesShowWhatIsChosen) {
  ASSERT_EQ(render({"--aov", "visibility"}, "v.png").status, 0);
  EXPECT_EQ(OIIO::ImageInput::open(path("v.png"))->spec().nchannels, 1);
  const Outcome outcome = render({"--aov", "id,normal"}, "n.png");
  EXPECT_EQ(outcome.out, path("n.png") + "\n" + path("n-normal.png") + "\n" + path("n-id.png") + "\n");
  EXPECT_EQ(OIIO::ImageInput::open(path("n.png"))->spec().nchannels, 3);
  EXPECT_EQ(render({"--quiet"}).out, "");
}

TEST_F(CommandTest, LocalScenesAreUploaded) {
  std::ofstream(folder.path() / "s.gltf") << "{}";
  ASSERT_EQ(run({"render", path("s.gltf"), "--method", "sm", "--size", "8x8", "-o", path("x.png")}).status,
            0);
  EXPECT_EQ(server.uploaded.at("s.gltf"), "{}");
  EXPECT_TRUE(server.lastRequest.scene().starts_with("digest:"));
  EXPECT_NE(run({"load", path("s.gltf")}).out.find(server.lastRequest.scene()), std::string::npos);
}

TEST_F(CommandTest, ListsAsTextAndAsJson) {
  EXPECT_NE(run({"scenes"}).out.find("builtin:discs"), std::string::npos);
  EXPECT_EQ(json::parse(run({"scenes", "--json"}).out)["scenes"][0]["reference"], "builtin:discs");
  EXPECT_NE(run({"methods"}).out.find("ray-traced"), std::string::npos);
  EXPECT_NE(run({"methods", "sm"}).out.find("texels=2048"), std::string::npos);
  EXPECT_EQ(json::parse(run({"--json", "methods", "sm"}).out)["parameters"][0]["default_value"], "2048");
  EXPECT_EQ(json::parse(run({"load", "builtin:discs", "--json"}).out)["loaded"], true);
  EXPECT_EQ(json::parse(run({"unload", "builtin:discs", "--json"}).out), json::object());
  EXPECT_EQ(json::parse(render({"--json"}).out)["results"][0]["method"], "sm");
}

}  // namespace
}  // namespace sundial::test
