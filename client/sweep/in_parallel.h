#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

namespace sundial::sweep {

// Calls job(0) ... job(count - 1), begun in order, up to `threads` at once. After a stop, or an exception of
// a job, which requests one, no more are begun. Returns when all that were begun have ended; throws the first
// exception.
void inParallel(std::size_t count, unsigned threads, std::stop_source stop,
                const std::function<void(std::size_t)>& job);

}  // namespace sundial::sweep
