// The file of results holds whole lines, whatever ended the sweep that wrote it.
#include "sweep/results_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <fstream>
#include <iterator>

#include "fake_server.h"

namespace sundial::sweep {
namespace {

namespace fs = std::filesystem;

class ResultsFileTest : public testing::Test {
 protected:
  test::TemporaryFolder folder;
  const fs::path path = folder.path() / "r.jsonl";
  const std::string good = R"({"case":"aa","frame_ms":1.5})"
                           "\n",
                    bad = R"({"case":"bb","error":{"code":"X"}})"
                          "\n";

  void put(const std::string& text) const { std::ofstream(path, std::ios::binary) << text; }
  std::string got() const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
};

TEST_F(ResultsFileTest, IsNeverOverwritten) {
  ASSERT_TRUE(ResultsFile::create(path));
  const auto again = ResultsFile::create(path);
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().message.find("--resume"), std::string::npos) << again.error().message;
  EXPECT_EQ(ResultsFile::create(folder.path() / "gone" / "r").error().code, grpc::FAILED_PRECONDITION);
}

TEST_F(ResultsFileTest, TakesLinesOneAfterTheOther) {
  auto file = ResultsFile::create(path);
  file->append(good);
  file->append(bad);
  EXPECT_EQ(got(), good + bad);
}

TEST_F(ResultsFileTest, ResumesWithWhatIsDone) {
  put(good + bad);
  const auto file = ResultsFile::resume(path);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->done(), (std::map<std::string, bool>{{"aa", false}, {"bb", true}}));
  EXPECT_TRUE(ResultsFile::resume(folder.path() / "new")->done().empty());
}

TEST_F(ResultsFileTest, CutsOffATornLineAtAnyByte) {
  for (std::size_t length = 0; length < good.size(); ++length) {
    put(bad + good.substr(0, length));
    {
      auto file = ResultsFile::resume(path);
      ASSERT_TRUE(file) << file.error().message;
      EXPECT_EQ(file->done().size(), 1u) << length;
      EXPECT_EQ(got(), bad) << length;
      file->append(good);
    }
    EXPECT_EQ(got(), bad + good) << length;
  }
}

TEST_F(ResultsFileTest, CutsOffGarbageAtTheEnd) {
  put(good + std::string(100, '\0') + "\n");
  ASSERT_TRUE(ResultsFile::resume(path));
  EXPECT_EQ(got(), good);
}

TEST_F(ResultsFileTest, RefusesAFileThatIsNoneOfItsOwn) {
  put(good + "a letter\n" + bad);
  const auto file = ResultsFile::resume(path);
  ASSERT_FALSE(file);
  EXPECT_NE(file.error().message.find("line 2"), std::string::npos) << file.error().message;
  EXPECT_EQ(got(), good + "a letter\n" + bad);
}

TEST_F(ResultsFileTest, HasOneWriter) {
  const auto first = ResultsFile::create(path);
  const auto second = ResultsFile::resume(path);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("another sweep"), std::string::npos) << second.error().message;
}

TEST_F(ResultsFileTest, LeavesNothingOfALineThatDoesntFit) {
  auto file = ResultsFile::create(path);
  file->append(good);
  signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = good.size() + 5;  // the next write is cut short there, as on a full disk
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(file->append(bad), std::runtime_error);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(got(), good);
  file->append(bad);
  EXPECT_EQ(got(), good + bad);
}

}  // namespace
}  // namespace sundial::sweep
