// Runs the command as its users do.
#pragma once

#include <sys/types.h>
#include <string>
#include <vector>

namespace sundial::test {

struct Outcome {
  int status = -1;  // exit status; 128 + the signal that ended it
  std::string out, err;
};

class Process {
 public:
  // `arguments` follow the program's path; `environment` is added to ours, "NAME=value".
  explicit Process(const std::string& program, const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment = {});
  void signal(int number) const;
  Outcome wait();

 private:
  pid_t pid_ = -1;
  int out_, err_;  // memory files
};

// "sundial" with these arguments, to its end.
Outcome sundial(const std::vector<std::string>& arguments, const std::vector<std::string>& environment = {});

// Until a server answers at this address. Throws if none does within a minute.
void waitForServer(const std::string& address);

std::string contents(const std::string& path);

}  // namespace sundial::test
