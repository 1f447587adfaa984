#include "command/command.h"
namespace sundial::command { void addCompare(CLI::App&, Action&) {} }
