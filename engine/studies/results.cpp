#include <fmt/format.h>

#include <fstream>
#include <heml/base/error.hpp>
#include <heml/base/hash.hpp>
#include <heml/base/write_file.hpp>
#include <heml/scenario/csv_text.hpp>
#include <heml/scenario/text_file.hpp>
#include <iterator>
#include <studies/machine.hpp>
#include <studies/results.hpp>

namespace heml {
namespace {

/// Hash of the executable's bytes; if they cannot be read, of version, compiler and flags.
std::string identity_of_program() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(program), {}};
  const Machine machine = this_machine();
  const std::string text = bytes.empty() ? machine.version + machine.compiler + machine.flags : bytes;
  std::uint64_t hash = 0;
  for (const char c : text) hash = hash_combine(hash, static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  return fmt::format("{:016x}", hash);
}

}  // namespace

std::string Results::build_identity() {
  static const std::string identity = identity_of_program();
  return identity;
}

Results::Results(const std::filesystem::path& file, std::string build) : file_(file), build_(std::move(build)) {
  std::string whole;
  if (std::filesystem::exists(file)) {
    const std::string text = read_text_file(file);
    whole = text.substr(0, text.rfind('\n') + 1);  // npos + 1 == 0: no complete line
    for (std::string_view rest = whole; !rest.empty();) {
      const Json line = Json::parse(consume_line(rest), nullptr, false);
      if (line.is_object() && line.value("build", "") == build_ && line.contains("key") && line.contains("result"))
        results_[line["key"]] = line["result"];
    }
  }
  write_file(file, whole);  // drops an incomplete last line
}

const Json* Results::find(const std::string& key) const {
  const auto found = results_.find(key);
  return found == results_.end() ? nullptr : &found->second;
}

const Json& Results::add(const std::string& key, const Json& result) {
  const std::string line = json_text({{"key", key}, {"build", build_}, {"result", result}}, file_.string());
  AppendFile out(file_, AppendFile::OpenMode::append);
  out.write(line + '\n');
  out.close();
  return results_[key] = Json::parse(line)["result"];
}

}  // namespace heml
