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

  void show(double done, double total);

 private:
  std::string title_;
  bool visible_;
  int percent_ = -1;  // on the screen now
};

}  // namespace sundial::command
