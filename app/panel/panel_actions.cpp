// Panel::carry_out(): what each action does.
#include <app/panel/panel.hpp>
#include <app/panel/undo_section.hpp>

namespace heml::panel {
namespace {

bool needs_dialog(Action action) {
  return action == Action::select_previous || action == Action::select_next || action == Action::open_selected;
}

}  // namespace

void Panel::carry_out(Action action, const Frame& frame, PanelActions& out) {
  const auto ask = [&](Request request) { out.requests.push_back(request); };
  if (question_.is_open()) return question_.press(action);
  if (dialog_.is_open() != needs_dialog(action) && action != Action::release && action != Action::quit) return;
  switch (action) {
    case Action::toggle_play:
      return ask(frame.paused ? Request::play : Request::pause);
    case Action::step:
      return ask(Request::step);
    case Action::reset:
      out.commands.emplace_back(Reset{});
      return;
    case Action::reset_all:
      out.commands.emplace_back(Reset{true});
      return;
    case Action::fit:
      return ask(Request::fit);
    case Action::wireframe:
      return view_.toggle_wireframe();
    case Action::section:
      return view_.section().toggle();
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
      help_.toggle();
      return;
    case Action::open:
      dialog_.open();
      return ask(Request::list);
    case Action::select_previous:
      return dialog_.select(-1);
    case Action::select_next:
      return dialog_.select(1);
    case Action::open_selected:
      return dialog_.open_selected(out);
    case Action::release:
      if (Rows::close_choices() || dialog_.close()) return;
      if (help_.is_open()) return help_.close();
      notices_.close();
      return ask(timeline_ && timeline_->leads_to_live() ? Request::live : Request::release);
    case Action::seek_previous:
      return ask(Request::previous_frame);
    case Action::seek_next:
      return ask(Request::next_frame);
    case Action::seek_start:
      return ask(Request::first_frame);
    case Action::seek_live:
      return ask(Request::live);
    case Action::resume:
      return ask(Request::resume);
    case Action::remove:
      return ask(Request::remove);
    case Action::leave_clamp:
      return ask(Request::leave_clamp);
    case Action::select_grasper:
      tool_.select(Tool::grasper);
      return;
    case Action::select_scalpel:
      tool_.select(Tool::scalpel);
      return;
    case Action::select_cautery:
      tool_.select(Tool::cautery);
      return;
    case Action::select_scissors:
      tool_.select(Tool::scissors);
      return;
    case Action::select_pin:
      tool_.select(Tool::pin);
      return;
    case Action::select_probe:
      tool_.select(Tool::probe);
      return;
    case Action::select_suture:
      tool_.select(Tool::suture);
      return;
    case Action::select_remover:
      tool_.select(Tool::remover);
      return;
    case Action::select_measure:
      tool_.select(Tool::measure);
      return;
    case Action::select_nodes:
      tool_.select(Tool::select);
      return;
    case Action::pin_selected:
      if (!selecting_.selection().is_empty()) out.commands.emplace_back(selecting_.pin());
      return;
    case Action::unpin_selected:
      if (!selecting_.selection().is_empty()) out.commands.emplace_back(selecting_.unpin());
      return;
    case Action::toggle_table:
      return tool_.toggle_table(frame, out);
    case Action::undo:
      return step_history(-1, frame, mesh_.openings(), out);
    case Action::redo:
      return step_history(1, frame, mesh_.openings(), out);
    case Action::record_video:
      return ask(Request::record_video);
    case Action::view_1:
    case Action::view_2:
    case Action::view_3:
    case Action::view_4:
      out.view = static_cast<std::size_t>(action) - static_cast<std::size_t>(Action::view_1);
      return;
    case Action::save_view_1:
    case Action::save_view_2:
    case Action::save_view_3:
    case Action::save_view_4:
      out.save_view = static_cast<std::size_t>(action) - static_cast<std::size_t>(Action::save_view_1);
      return;
    case Action::look_front:
    case Action::look_back:
    case Action::look_left:
    case Action::look_right:
    case Action::look_top:
    case Action::look_bottom:
      out.look = static_cast<StandardView>(static_cast<int>(action) - static_cast<int>(Action::look_front));
      return;
    case Action::orthographic:
      out.orthographic = !view_.is_orthographic();
      return;
    case Action::quit:
      return ask(Request::quit);
  }
}

}  // namespace heml::panel
