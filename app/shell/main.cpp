// The lampblack command.
#include "app/shell/command_line.hpp"

int main(int argc, char** argv) {
  return lampblack::app::runCommandLine(argc, argv);
}
