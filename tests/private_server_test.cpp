// Without --server the command starts a sundiald of its own, and nothing of it is left afterwards: whether
// the command ends well, badly, by Ctrl-C or by SIGKILL.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "fake_server.h"
#include "process.h"

namespace sundial::test {
namespace {

namespace fs = std::filesystem;

class PrivateServerTest : public testing::Test {
 protected:
  TemporaryFolder folder;  // also the command's TMPDIR
  std::string fifo = (folder.path() / "log").string();
  int log = -1;
  std::string said;

  void SetUp() override {
    fs::create_directory(folder.path() / "tmp");
    ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
    log = open(fifo.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);  // so that opening it to write never blocks
  }
  void TearDown() override { close(log); }

  std::vector<std::string> environment(const std::string& more = "A=B") const {
    return {"SUNDIALD=" FAKE_SUNDIALD, "FAKE_SUNDIALD_LOG=" + fifo,
            "TMPDIR=" + (folder.path() / "tmp").string(), more};
  }

  // Reads the server's words up to `word`, or, if empty, to its death: when nobody holds the FIFO any more.
  bool hears(const std::string& word) {
    for (;;) {
      if (!word.empty() && said.find(word) != std::string::npos) return true;
      pollfd waiting{log, POLLIN, 0};
      if (poll(&waiting, 1, 20'000) <= 0) return false;
      char text[256];
      const ssize_t count = read(log, text, sizeof text);
      if (count > 0) said.append(text, static_cast<std::size_t>(count));
      if (count == 0) return word.empty() && !said.empty();
    }
  }

  // The server that said it was listening is dead, and its socket's folder is gone.
  void expectNothingLeft() {
    EXPECT_TRUE(hears("")) << "the server lives on";
    std::istringstream words(said);
    std::string listening, socket;
    pid_t pid = 0;
    words >> listening >> pid >> socket;
    EXPECT_EQ(listening, "listening");
    EXPECT_FALSE(fs::exists(socket)) << socket;
    EXPECT_TRUE(fs::is_empty(folder.path() / "tmp"));
  }

  // The signal arrives in the middle of a rendering.
  void expectNothingLeftAfter(int signal) {
    const std::string picture = (folder.path() / "x.png").string();
    Process command(SUNDIAL_COMMAND, {"render", "builtin:discs", "--method", "sm", "-o", picture},
                    environment("FAKE_SUNDIALD_HANGS=1"));
    ASSERT_TRUE(hears("rendering"));
    command.signal(signal);
    const Outcome outcome = command.wait();
    EXPECT_EQ(outcome.status, 128 + signal);
    EXPECT_EQ(outcome.err, signal == SIGKILL ? "" : "sundial: interrupted\n");
    EXPECT_FALSE(fs::exists(picture));
    expectNothingLeft();
  }
};

TEST_F(PrivateServerTest, EndsWithTheCommand) {
  const Outcome outcome = sundial({"scenes"}, environment());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("builtin:discs"), std::string::npos);
  expectNothingLeft();
}

TEST_F(PrivateServerTest, EndsWithAFailedCommand) {
  EXPECT_EQ(sundial({"methods", "nope"}, environment()).status, 1);
  expectNothingLeft();
}

TEST_F(PrivateServerTest, EndsOnCtrlC) { expectNothingLeftAfter(SIGINT); }
TEST_F(PrivateServerTest, EndsWithATerminatedCommand) { expectNothingLeftAfter(SIGTERM); }
TEST_F(PrivateServerTest, EndsWithAKilledCommand) { expectNothingLeftAfter(SIGKILL); }

TEST_F(PrivateServerTest, ItsLastWordsAreTheCommandsError) {
  const fs::path script = folder.path() / "sundiald";
  std::ofstream(script)
      << "#!/bin/sh\necho first >&2\necho \"no device 'x'; there is llvmpipe\" >&2\nexit 1\n";
  fs::permissions(script, fs::perms::owner_all);
  std::vector<std::string> variables = environment();
  variables[0] = "SUNDIALD=" + script.string();
  const Outcome outcome = sundial({"--device", "x", "scenes"}, variables);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "sundial: sundiald didn't start: no device 'x'; there is llvmpipe\n");
  EXPECT_TRUE(fs::is_empty(folder.path() / "tmp"));
}

TEST_F(PrivateServerTest, AMissingServerIsOneLine) {
  std::vector<std::string> variables = environment();
  variables[0] = "SUNDIALD=/nowhere/sundiald";
  const Outcome outcome = sundial({"scenes"}, variables);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("/nowhere/sundiald"), std::string::npos);
}

}  // namespace
}  // namespace sundial::test
