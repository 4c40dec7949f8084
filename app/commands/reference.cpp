// `heml reference`: the pages, written.
#include <fmt/format.h>

#include <app/commands/commands.hpp>
#include <app/commands/reference.hpp>
#include <heml/base/write_file.hpp>

namespace heml {

int write_reference(const ReferenceArguments& arguments, const CLI::App& program) {
  make_folder(arguments.out);
  const std::pair<const char*, std::string> pages[] = {
      {"commands.md", commands_page(program)}, {"scene-format.md", scene_page()}, {"laws.md", laws_page()}};
  for (const auto& [name, text] : pages) {
    expect_writable_file(arguments.out / name);
    write_file(arguments.out / name, text);
  }
  fmt::print("commands.md, scene-format.md and laws.md are in {}\n", arguments.out.string());
  return exit_done;
}

}  // namespace heml
