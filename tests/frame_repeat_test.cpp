// The same job gives the same bytes, plans and counts of work: again, after other jobs, on another renderer,
// and however many threads the driver uses.
#include <cstdio>
#include <cstdlib>

#include "support/fingerprint.h"

namespace sundial::test {
namespace {

class FrameRepeat : public RendererTest {};

TEST_F(FrameRepeat, TheSameJobGivesTheSameBytesWhateverCameBefore) {
  std::vector<std::string> first;
  for (const RenderJob& job : fingerprintJobs()) first.push_back(fingerprint(renderer(), job));
  // Again on the same scenes that the device holds, each job twice in a row.
  const auto jobs = fingerprintJobs();
  for (std::size_t i = jobs.size(); i-- > 0;)
    for (int again = 0; again < 2; ++again) EXPECT_EQ(fingerprint(renderer(), jobs[i]), first[i]);
}

TEST_F(FrameRepeat, ImagesDoNotDependOnRepetitionsOrABaseline) {
  RenderJob job = fingerprintJobs().at(0);
  // A delayed plan's first frame has its passes in another order than those after it.
  std::erase_if(job.methods, [](const Method& m) { return m.settings.plan == PlanTiming::delayed; });
  const std::string once = fingerprint(renderer(), job);
  job.repetitions = 2;
  job.baseline = method("sm,texels=256,lookup=pcf");
  EXPECT_EQ(fingerprint(renderer(), job), once);
}

// Standard output of the helper, LP_NUM_THREADS set: lavapipe's threads; other drivers take no notice.
std::string fingerprintsWithThreads(int threads) {
  const std::string command = fmt::format("LP_NUM_THREADS={} '{}'", threads, PRINT_FINGERPRINTS);
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("can't run " + command);
  std::string text;
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, n);
  EXPECT_EQ(pclose(pipe), 0) << command;
  return text;
}

TEST(FrameRepeatAcrossProcesses, TheDriversThreadsChangeNothing) {
  const std::string none = fingerprintsWithThreads(0);
  EXPECT_GT(none.size(), 1000u);
  EXPECT_EQ(fingerprintsWithThreads(1), none);
  EXPECT_EQ(fingerprintsWithThreads(2), none);
}

}  // namespace
}  // namespace sundial::test
