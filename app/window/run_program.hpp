#pragma once
// Other programs beside the window.
#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace heml::window {

/// A program on $PATH; empty where there is none.
std::filesystem::path find_program(const std::string& name);

/// Runs a program, silent, to its end and returns its exit code (-1: it was killed or could not start), or nothing as
/// soon as `leave` is true: it then goes on by itself.
std::optional<int> run_program(std::vector<std::string> words, const std::atomic<bool>& leave);

/// The calling thread, and programs it runs, get less of the processor than others; enough for somebody to wait for it.
void lower_priority();

}  // namespace heml::window
