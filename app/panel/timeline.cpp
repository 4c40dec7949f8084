#include <fmt/format.h>

#include <algorithm>
#include <app/panel/quantity.hpp>
#include <app/panel/timeline.hpp>
#include <cmath>

namespace heml::panel {
namespace {

constexpr float bar_height = 2.1f, timeline_margin = 0.7f, widest_timeline = 60, buttons_width = 9.5f,
                time_width = 4.6f;  // em

constexpr ImGuiWindowFlags bar_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing;

std::string seconds_text(double seconds) {
  return seconds < 60 ? fmt::format("{:.2f} s", seconds)
                      : fmt::format("{}:{:04.1f}", static_cast<long>(seconds / 60), std::fmod(seconds, 60));
}

std::string time_hint(const Timeline& time) {
  return fmt::format(
      "Shown time since the start, s; a reset does not set it back. Left, Right and Home move too; Resume (B) "
      "continues "
      "from there.\n\n{} frames in memory, {:.1f} of {:.0f} MB. When full, every second frame is dropped.",
      time.frames, static_cast<double>(time.bytes) / 1e6, static_cast<double>(time.room) / 1e6);
}

/// The track and the mapping between ticks and pixels.
struct Track {
  ImVec2 from, to;
  const Timeline& time;
  float at(long tick) const {
    const double share = static_cast<double>(tick) / static_cast<double>(std::max(time.end, 1l));
    return from.x + static_cast<float>(std::clamp(share, 0.0, 1.0)) * (to.x - from.x);
  }
  long tick_at(float x) const {
    const double share = std::clamp((x - from.x) / std::max(1.0f, to.x - from.x), 0.0f, 1.0f);
    return std::lround(share * static_cast<double>(time.end));
  }
};

void draw_track(const Track& track) {
  const Timeline& time = track.time;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = (track.from.y + track.to.y) / 2, half = em(0.22f);
  const auto part = [&](float left, float right, ImU32 colour) {
    if (right > left) list.AddRectFilled({left, middle - half}, {right, middle + half}, colour, half);
  };
  part(track.from.x, track.to.x, colours::track);
  part(track.at(time.first), track.at(time.live), time.shown ? colours::faint : colours::fill);
  if (time.shown) part(track.at(time.first), track.at(*time.shown), colours::fill);
  if (time.fast_forward_target > 0)
    list.AddCircle({track.at(time.fast_forward_target), middle}, em(0.42f), colours::warning, 20, em(0.12f));
  list.AddCircleFilled({track.at(time.shown.value_or(time.live)), middle}, em(0.46f), colours::accent, 24);
}

void follow_mouse(Rows& rows, const Track& track, PanelActions& out) {
  const Timeline& time = track.time;
  const ImVec2 size(track.to.x - track.from.x, track.to.y - track.from.y);
  ImGui::InvisibleButton("track", size);
  const float x = ImGui::GetIO().MousePos.x;
  long tick = track.tick_at(x);
  double seconds = seconds_at(time, tick);
  if (time.moment_at && tick <= time.live) {  // what is told is what a click shows
    const TimelineMoment moment = time.moment_at(tick);
    tick = moment.tick;
    seconds = moment.elapsed;
  }
  if (ImGui::IsItemActive() && (ImGui::IsMouseClicked(0) || ImGui::GetIO().MouseDelta.x != 0)) {
    if (tick <= time.live) out.seek_to = tick;
  }
  if (ImGui::IsItemDeactivated() && tick > time.live) out.seek_to = tick;  // ahead: once, on release
  rows.explain({"Timeline", ""});
  if (!ImGui::IsItemHovered()) return;
  // The tooltip is above the bar, so that it does not cover the buttons.
  ImGui::SetNextWindowPos({x, track.from.y - em(0.8f)}, ImGuiCond_Always, {0.5f, 1});
  ImGui::BeginTooltip();
  ImGui::Text("%s of %s", seconds_text(seconds).c_str(), seconds_text(seconds_at(time, time.end)).c_str());
  if (!ImGui::IsAnyMouseDown())
    ImGui::TextDisabled("%s", tick > time.live ? "release here to fast-forward to it" : "drag to show past frames");
  ImGui::EndTooltip();
}

}  // namespace

double seconds_at(const Timeline& time, long tick) {
  if (!time.elapsed) return static_cast<double>(tick) / time.rate;
  return *time.elapsed + static_cast<double>(tick - time.shown.value_or(time.live)) / time.rate;
}

float timeline_height() { return em(bar_height + timeline_margin); }

void draw_timeline(Rows& rows, const Timeline& time, const Area& free, std::vector<Action>& pressed, PanelActions& out,
                   Area& place) {
  const float width = std::min(free.width() - em(2 * timeline_margin), em(widest_timeline)),
              middle = (free.from.x + free.to.x) / 2;
  const float top = free.to.y - timeline_height();
  place = {{middle - width / 2, top}, {middle + width / 2, top + em(bar_height)}};
  ImGui::SetNextWindowPos(place.from);
  ImGui::SetNextWindowSize({width, em(bar_height)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em(0.7f), em(0.3f)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  if (ImGui::Begin("timeline", nullptr, bar_flags)) {
    const float height = ImGui::GetContentRegionAvail().y, left = ImGui::GetCursorScreenPos().x;
    const bool back = time.shown.has_value();
    const double seconds = seconds_at(time, time.shown.value_or(time.live));
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, back ? colours::warning : colours::text);
    ImGui::TextUnformatted(seconds_text(seconds).c_str());
    ImGui::PopStyleColor();
    rows.explain({"Shown time", time_hint(time)});
    const float end = place.to.x - em(0.9f) - em(buttons_width);  // also without buttons: the track is not to move
    const Track track{{left + em(time_width), place.from.y + em(0.3f)}, {end, place.from.y + em(0.3f) + height}, time};
    ImGui::SetCursorScreenPos(track.from);
    draw_track(track);
    follow_mouse(rows, track, out);
    ImGui::SetCursorScreenPos({end + em(0.6f), place.from.y + em(0.3f)});
    if (time.resume_progress) {
      ImGui::AlignTextToFramePadding();
      ImGui::Text("Replaying %d %%", *time.resume_progress);
      rows.explain({"Replaying", "Replays the session up to that time as fast as possible; Esc cancels."});
    } else if (time.is_opening) {
      ImGui::AlignTextToFramePadding();
      ImGui::TextUnformatted("Opening …");
      rows.explain(
          {"Opening",
           "Another file is being read. What is done to this body meanwhile would be lost, so it takes no changes."});
    } else if (back) {
      if (rows.button({"Resume",
                       "Resumes from this time by replaying the session up to it, bit for bit; a recording "
                       "(being written or opened) continues in a new file (B)."}))
        pressed.push_back(Action::resume);
      ImGui::SameLine(0, em(0.4f));
      if (rows.button({"Live", "Back to the live simulation (End, Esc)."})) pressed.push_back(Action::seek_live);
    }
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace heml::panel
