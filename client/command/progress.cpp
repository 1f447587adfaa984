#include "command/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace sundial::command {

ProgressBar::ProgressBar(std::string title, bool quiet)
    : title_(std::move(title)), visible_(!quiet && isatty(STDERR_FILENO)) {
  show(0, 1);
}

ProgressBar::~ProgressBar() {
  if (visible_) fmt::print(stderr, "\r\x1b[K");
}

void ProgressBar::show(double done, double total, const std::string& note) {
  constexpr int kWidth = 30;  // columns
  const int percent = total > 0 ? static_cast<int>(100 * std::clamp(done / total, 0.0, 1.0)) : 0;
  if (!visible_ || (percent == percent_ && note == note_)) return;
  percent_ = percent;
  note_ = note;
  const int full = kWidth * percent / 100;
  fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {:3}%{}{}\x1b[K", title_, "", full, "", kWidth - full, percent,
             note.empty() ? "" : ", ", note);
  std::fflush(stderr);
}

}  // namespace sundial::command
