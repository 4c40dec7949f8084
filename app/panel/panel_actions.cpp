// Panel::carry_out(): what each action does.
#include <app/panel/panel.hpp>

namespace heml::panel {
namespace {

bool needs_dialog(Action action) {
  return action == Action::choose_previous || action == Action::choose_next || action == Action::open_chosen;
}

}  // namespace

void Panel::carry_out(Action action, const Frame& frame, PanelActions& out) {
  const auto ask = [&](Request request) { out.requests.push_back(request); };
  if (dialog_.is_open() != needs_dialog(action) && action != Action::release && action != Action::quit) return;
  switch (action) {
    case Action::toggle_play:
      return ask(frame.paused ? Request::play : Request::pause);
    case Action::step:
      return ask(Request::step);
    case Action::reset:
      out.commands.emplace_back(Reset{});
      return;
    case Action::fit:
      return ask(Request::fit);
    case Action::wireframe:
      return view_.toggle_wireframe();
    case Action::show_tissue:
      return view_.show(Field::none, out);
    case Action::show_displacement:
      return view_.show(Field::displacement, out);
    case Action::show_stretch:
      return view_.show(Field::stretch, out);
    case Action::show_von_mises:
      return view_.show(Field::von_mises, out);
    case Action::show_volume_ratio:
      return view_.show(Field::volume_ratio, out);
    case Action::show_error:
      return view_.show(Field::error, out);
    case Action::screenshot:
      return ask(Request::screenshot);
    case Action::save:
      return ask(Request::save);
    case Action::hide:
      hidden_ = !hidden_;
      return;
    case Action::help:
      helping_ = !helping_;
      return;
    case Action::open:
      dialog_.open();
      return ask(Request::list);
    case Action::choose_previous:
      return dialog_.choose(-1);
    case Action::choose_next:
      return dialog_.choose(1);
    case Action::open_chosen:
      return dialog_.open_chosen(out);
    case Action::release:
      if (dialog_.close()) return;
      if (helping_ || notices_.close()) helping_ = false;
      return ask(timeline_ && (timeline_->shown || timeline_->returning) ? Request::now : Request::release);
    case Action::seek_earlier:
      return ask(Request::earlier);
    case Action::seek_later:
      return ask(Request::later);
    case Action::seek_start:
      return ask(Request::first);
    case Action::seek_now:
      return ask(Request::now);
    case Action::resume:
      return ask(Request::resume);
    case Action::remove:
      return ask(Request::remove);
    case Action::take_grasper:
      tool_.select(Tool::grasper);
      return;
    case Action::take_scalpel:
      tool_.select(Tool::scalpel);
      return;
    case Action::take_pin:
      tool_.select(Tool::pin);
      return;
    case Action::take_probe:
      tool_.select(Tool::probe);
      return;
    case Action::take_suture:
      tool_.select(Tool::suture);
      return;
    case Action::toggle_table:
      return tool_.toggle_table(frame, out);
    case Action::undo:
      out.commands.emplace_back(Undo{});
      return;
    case Action::film:
      return ask(Request::film);
    case Action::view_1:
    case Action::view_2:
    case Action::view_3:
    case Action::view_4:
      out.view = static_cast<std::size_t>(action) - static_cast<std::size_t>(Action::view_1);
      return;
    case Action::keep_view_1:
    case Action::keep_view_2:
    case Action::keep_view_3:
    case Action::keep_view_4:
      out.keep_view = static_cast<std::size_t>(action) - static_cast<std::size_t>(Action::keep_view_1);
      return;
    case Action::quit:
      return ask(Request::quit);
  }
}

}  // namespace heml::panel
