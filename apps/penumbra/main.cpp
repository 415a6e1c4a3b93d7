#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "command_line.h"
#include "commands.h"
#include "interrupt.h"

namespace penumbra::app {
namespace {

int report(int status, const std::string& text) {
  std::fputs(("penumbra: " + text + '\n').c_str(), stderr);
  return status;
}

void run_command(Arguments& arguments, Console& console) {
  switch (arguments.command) {
    case Command::render:
      return run_render(arguments, console);
    case Command::probe:
      return run_probe(arguments, console);
    case Command::export_shader:
      return run_export(arguments, console);
    case Command::bake:
      return run_bake(arguments, console);
    case Command::info:
      return run_info(arguments);
    case Command::make_new:
      return run_new(arguments);
  }
}

void run(Arguments& arguments) {
  const ThreadLimit limit(arguments.threads);
  Console console(arguments.quiet);
  try {
    run_command(arguments, console);
  } catch (...) {
    console.clear();
    throw;
  }
}

int run_program(int argc, char** argv) try {
  stop_on_interrupt();
  std::string answer;
  if (auto arguments = parse_command_line(argc, argv, answer))
    run(*arguments);
  else
    print(answer);
  return was_interrupted() ? 130 : 0;
} catch (const InputError& error) {
  return report(2, error.what());
} catch (const Cancelled&) {
  return report(130, "stopped");
} catch (const std::bad_alloc&) {
  return report(1, "the memory is not enough; choose a smaller size or scene");
} catch (const std::exception& error) {
  return report(1, error.what());
}

}  // namespace
}  // namespace penumbra::app

int main(int argc, char** argv) { return penumbra::app::run_program(argc, argv); }
