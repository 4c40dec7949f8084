#pragma once
// Child processes.
#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace heml::window {

/// Path of a program on $PATH; empty if there is none.
std::filesystem::path find_program(const std::string& name);

/// Runs a program to its end, with its streams on /dev/null, and returns its exit code (-1: killed, or could not
/// start). Returns nothing as soon as `leave` is true; the program keeps running.
std::optional<int> run_program(std::vector<std::string> words, const std::atomic<bool>& leave);

/// Starts a program, with its streams on /dev/null, and lets it run.
void start_program(std::vector<std::string> words);

/// Gives the calling thread, and programs it runs, a nice value of 5.
void lower_priority();

}  // namespace heml::window
