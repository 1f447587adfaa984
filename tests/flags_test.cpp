// sundiald's command line and its configuration file: what they set, which one wins, what they refuse.
#include "flags.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace sundial {
namespace {

Result<std::optional<Flags>> parse(std::vector<const char*> arguments, std::string* said = nullptr) {
  arguments.insert(arguments.begin(), "sundiald");
  std::string text;
  auto flags = parseFlags(static_cast<int>(arguments.size()), arguments.data(), text);
  if (said) *said = text;
  return flags;
}

class FlagsTest : public ::testing::Test {
 protected:
  ~FlagsTest() override { std::filesystem::remove(path); }
  const char* config(const std::string& text) {
    std::ofstream(path) << text;
    return path.c_str();
  }
  const std::string path = fmt::format("{}/sundial-flags-{}.toml", ::testing::TempDir(), ::getpid());
};

TEST_F(FlagsTest, DefaultsAreSafe) {
  const auto flags = parse({});
  ASSERT_TRUE(flags && *flags);
  const ServerOptions& server = (**flags).server;
  EXPECT_EQ(server.listen, std::vector<std::string>{"127.0.0.1:50051"});
  EXPECT_EQ(server.queue.waiting, 64u);
  EXPECT_EQ(server.queue.waitingPerClient, 8u);
  EXPECT_EQ(server.calls.request.imageSide, 8192u);
  EXPECT_EQ(server.calls.request.outputBytes, 512u << 20);
  EXPECT_EQ(server.calls.defaultDeadline, std::chrono::seconds(60));
  EXPECT_EQ(server.calls.maxDeadline, std::chrono::seconds(900));
  EXPECT_EQ(server.calls.stallTimeout, std::chrono::seconds(30));
  EXPECT_EQ((**flags).drain, std::chrono::seconds(30));
  EXPECT_FALSE(server.tls);
  EXPECT_FALSE(server.store.root);
}

TEST_F(FlagsTest, FlagsComeBeforeTheFile) {
  const char* file =
      config("queue = 7\nlisten = [\"127.0.0.1:1\", \"unix:/tmp/x\"]\ndrain-s = 0.5\nvalidation = true\n");
  const auto flags = parse({"--config", file, "--queue", "9"});
  ASSERT_TRUE(flags && *flags) << flags.error().message;
  EXPECT_EQ((**flags).server.queue.waiting, 9u);
  EXPECT_EQ((**flags).server.listen, (std::vector<std::string>{"127.0.0.1:1", "unix:/tmp/x"}));
  EXPECT_EQ((**flags).drain, std::chrono::milliseconds(500));
  EXPECT_TRUE((**flags).validation);
}

TEST_F(FlagsTest, ListenMayBeRepeated) {
  const auto flags = parse({"--listen", "127.0.0.1:1", "--listen", "[::1]:2"});
  ASSERT_TRUE(flags && *flags);
  EXPECT_EQ((**flags).server.listen, (std::vector<std::string>{"127.0.0.1:1", "[::1]:2"}));
}

TEST_F(FlagsTest, WhatIsWrongIsSaidInOneLine) {
  const auto refused = [](std::vector<const char*> arguments, const std::string& expected) {
    const auto flags = parse(arguments);
    ASSERT_FALSE(flags) << expected;
    EXPECT_NE(flags.error().message.find(expected), std::string::npos) << flags.error().message;
    EXPECT_EQ(flags.error().message.find('\n'), std::string::npos);
    EXPECT_EQ(flags.error().code, ErrorCode::invalidArgument);
  };
  refused({"--nonsense"}, "--nonsense");
  refused({"--queue", "0"}, "--queue");
  refused({"--max-image-side", "100000"}, "--max-image-side");
  refused({"--log-level", "loud"}, "--log-level");
  refused({"--scene-root", "/no/such/folder"}, "/no/such/folder");
  refused({"--tls-cert", "x"}, "--tls-key");
  refused({"--tls-cert", "/no/cert", "--tls-key", "/no/key"}, "--tls-cert: can't read /no/cert");
  refused({"--config", "/no/such/file"}, "/no/such/file");
  refused({"--config", config("queue = \n")}, "line 1");
  refused({"--config", config("qeue = 1\n")}, "qeue");
  refused({"--config", config("queue = 0\n")}, "--queue");
  refused({"--config", config("[queue]\nx = 1\n")}, "queue must be");
}

TEST_F(FlagsTest, HelpHasAnExample) {
  std::string said;
  const auto flags = parse({"--help"}, &said);
  ASSERT_TRUE(flags);
  EXPECT_FALSE(*flags);
  EXPECT_NE(said.find("Example:\n  sundiald --listen"), std::string::npos);
  EXPECT_NE(said.find("Exit status: 0"), std::string::npos);
}

}  // namespace
}  // namespace sundial
