// The lampblack command.
#include "app/run/command_line.hpp"

int main(int argc, char** argv) {
  return lampblack::app::runCommandLine(argc, argv);
}
