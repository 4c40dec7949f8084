#include <algorithm>
#include <app/panel/decimal_comma.hpp>

namespace heml::panel {
namespace {

/// ImGui reads the clipboard with a plain function.
thread_local const char* (*system_clipboard)(void*) = nullptr;

const char* read_clipboard(void* user) {
  static thread_local std::string pasted;  // ImGui reads it after the return
  const char* text = system_clipboard ? system_clipboard(user) : nullptr;
  if (!text) return nullptr;
  pasted = with_decimal_point(text);
  return pasted.c_str();
}

}  // namespace

std::string with_decimal_point(std::string_view number) {
  const std::size_t comma = number.rfind(','), point = number.rfind('.');
  const bool is_decimal = comma != number.npos && number.find(',') == comma && (point == number.npos || point < comma);
  std::string text(number);
  std::erase(text, is_decimal ? '.' : ',');  // they group thousands
  std::replace(text.begin(), text.end(), ',', '.');
  return text;
}

CommaAsPoint::CommaAsPoint(bool active) : clipboard_(ImGui::GetIO().GetClipboardTextFn) {
  if (!active) return;
  ImGuiIO& io = ImGui::GetIO();
  for (ImWchar& letter : io.InputQueueCharacters)
    if (letter == ',') letter = '.';
  system_clipboard = clipboard_;
  io.GetClipboardTextFn = read_clipboard;
}

CommaAsPoint::~CommaAsPoint() { ImGui::GetIO().GetClipboardTextFn = clipboard_; }

}  // namespace heml::panel
