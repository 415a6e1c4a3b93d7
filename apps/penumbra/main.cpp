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

int run_command(Arguments& arguments, Console& console) {
  switch (arguments.command) {
    case Command::render:
      run_render(arguments, console);
      return 0;
    case Command::probe:
      run_probe(arguments, console);
      return 0;
    case Command::export_shader:
      run_export(arguments, console);
      return 0;
    case Command::animate:
      run_animate(arguments, console);
      return 0;
    case Command::bake:
      run_bake(arguments, console);
      return 0;
    case Command::compare:
      run_compare(arguments, console);
      return 0;
    case Command::info:
      run_info(arguments);
      return 0;
    case Command::make_new:
      run_new(arguments);
      return 0;
    case Command::diff:
      return run_diff(arguments);
  }
  return 0;
}

int run(Arguments& arguments) {
  const ThreadLimit limit(arguments.threads);
  Console console(arguments.quiet);
  try {
    return run_command(arguments, console);
  } catch (...) {
    console.clear();
    throw;
  }
}

int run_program(int argc, char** argv) try {
  stop_on_interrupt();
  std::string answer;
  if (auto arguments = parse_command_line(argc, argv, answer)) {
    const int status = run(*arguments);
    return was_interrupted() && status == 0 ? 130 : status;
  }
  print(answer);
  return 0;
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
