// A bar on a terminal, nothing in a pipe.
#pragma once

#include <string>

namespace sundial::command {

class ProgressBar {
 public:
  ProgressBar(std::string title, bool quiet);
  ~ProgressBar();  // wipes the bar
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // `note`, if any, stands beside the bar.
  void show(double done, double total, const std::string& note = {});

 private:
  std::string title_;
  bool visible_;
  int percent_ = -1;  // this and the following are on the screen now
  std::string note_;
};

}  // namespace sundial::command
