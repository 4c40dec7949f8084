// The reference page of the command line, from what the command line is parsed by.
#include <fmt/format.h>

#include <app/commands/command_line.hpp>
#include <app/commands/markdown.hpp>
#include <app/commands/reference.hpp>

namespace heml {
namespace {

/// What the page says of a command beside its help: links to other pages.
struct SeeAlso {
  std::string_view command, text;
};
constexpr SeeAlso see_also[] = {
    {"run", "Mouse, keys, panel, recordings: [using heml](using.md)."},
    {"replay", "What is promised bit for bit: [determinism](../../engine/docs/determinism.md)."},
    {"solve", "Keys of `outputs`: [scene format](scene-format.md#outputs)."},
    {"explain", "Keys of scenes: [scene format](scene-format.md)."},
    {"probe", "Laws and their parameters: [laws](../../engine/docs/laws.md)."},
    {"materials", "The same as a page: [laws](../../engine/docs/laws.md)."},
    {"bench", "What was measured: [performance](../../engine/docs/performance.md)."},
    {"study", "What they found: [verification](../../engine/docs/verification.md)."},
};

/// "FILE" and "> 0" of "FILE:> 0": the type, and the check that CLI11 appends to it.
std::pair<std::string, std::string> type_and_range(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  return {type.substr(0, colon), colon == type.npos ? "" : type.substr(colon + 1)};
}

std::string option_name(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name();
  const bool is_flag = option.get_items_expected_max() == 0;
  return option.get_name() + (is_flag ? "" : " " + type_and_range(option).first);
}

std::string option_text(const CLI::Option& option) {
  std::string text = option.get_required() ? "required; " : "";
  text += option.get_description();
  if (const std::string range = type_and_range(option).second; !range.empty()) text += "; " + range;
  if (!option.get_default_str().empty()) text += fmt::format("; default `{}`", option.get_default_str());
  return text;
}

bool is_help(const CLI::Option& option) { return option.get_name() == "--help"; }

/// "heml solve SCENE --out DIR": what must be given, and in brackets what is a place on the line and may be left out.
std::string usage(const CLI::App& command) {
  std::string text = "heml " + command.get_name();
  for (const bool positional : {true, false})
    for (const CLI::Option* option : command.get_options()) {
      if (option->get_positional() != positional || is_help(*option)) continue;
      if (option->get_required()) text += " " + option_name(*option);
      if (!option->get_required() && positional) text += fmt::format(" [{}]", option_name(*option));
    }
  return text;
}

std::string section_of(const CLI::App& command) {
  std::string text =
      fmt::format("## {}\n\n`{}` {}.\n\n", command.get_name(), usage(command), command.get_description());
  MarkdownTable options({"option", ""});
  for (const bool positional : {true, false})
    for (const CLI::Option* option : command.get_options())
      if (option->get_positional() == positional && !is_help(*option))
        options.add({fmt::format("`{}`", option_name(*option)), option_text(*option)});
  text += options.text() + markdown_of_help(command.get_footer());
  for (const SeeAlso& also : see_also)
    if (also.command == command.get_name()) text += std::string(also.text) + "\n\n";
  return text;
}

std::string exit_codes() {
  std::string text = "## Exit codes\n\n";
  MarkdownTable table({"code", "meaning"});
  for (const ExitCodeInfo& info : exit_code_table())
    table.add({std::to_string(static_cast<int>(info.code)),
               *info.detail ? fmt::format("{}: {}", info.meaning, info.detail) : std::string(info.meaning)});
  return text + table.text() +
         "Bad input gives one message that names the file, the place in it (key, line, element or node) and the "
         "remedy.\n\n";
}

}  // namespace

std::string commands_page(const CLI::App& program) {
  std::string text = fmt::format(
      "# Commands\n\n"
      "Written by `heml reference`. `heml COMMAND --help` prints the same. Without a command the default scene "
      "opens.\n\n"
      "SCENE is {}. A bare mesh or surface gets the default\n"
      "scene round it: soft tissue under gravity, held so that it rests, in real time ([your own organ](your-own-organ.md)).\n\n",
      scene_files);
  MarkdownTable commands({"command", "does"});
  for (const CommandDefinition& definition : command_definitions())
    commands.add({fmt::format("[`{0}`](#{0})", definition.name), definition.description});
  MarkdownTable options({"option", ""});
  options.add({"`-h`, `--help`", "of the program and of every command"});
  options.add({"`--version`", "prints the version"});
  text +=
      commands.text() + options.text() +
      "Numbers refuse `nan`, `inf` and what is out of range. No command writes over a file that it reads; an output "
      "that cannot be written is refused\n"
      "before the run. Files are written beside their name and renamed when complete. Long work shows its progress "
      "on stderr when that is a terminal.\n\n";
  text += exit_codes();
  for (const CommandDefinition& definition : command_definitions())
    text += section_of(*program.get_subcommand(definition.name));
  text.pop_back();  // no empty line at the end
  return text;
}

}  // namespace heml
