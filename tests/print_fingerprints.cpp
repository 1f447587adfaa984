// Prints the fingerprints of a few jobs, for a test that runs it in several environments.
#include <cstdio>
#include <exception>

#include "support/fingerprint.h"

int main() {
  using namespace sundial;
  try {
    const auto renderer = Renderer::create("", true);
    if (!renderer) throw std::runtime_error(renderer.error().message);
    for (const RenderJob& job : test::fingerprintJobs())
      std::fputs(test::fingerprint(**renderer, job).c_str(), stdout);
    return (*renderer)->validationMessages() == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
