#!/usr/bin/env python3
"""Draws tick.svg, the phases of one tick with the file of each: python3 engine/docs/tick.py

Standard library only. Names a file that does not exist: exit code 1.
"""
import pathlib
import sys
from xml.sax.saxutils import escape

HERE = pathlib.Path(__file__).resolve().parent
SOURCES = HERE.parent / "heml"

WIDTH, MARGIN, GAP = 880, 56, 16
INNER = WIDTH - 2 * MARGIN
COLUMN = (INNER - 2 * GAP) / 3
SANS = "Helvetica, Arial, 'DejaVu Sans', sans-serif"
MONO = "Menlo, Consolas, 'DejaVu Sans Mono', monospace"
TITLE, TEXT, FILE, SMALL = 15, 12.5, 11.5, 12  # font sizes, px
LINE = 17
FILL = {"session": "#e8eef7", "world": "#eef5ea", "method": "#fdf3e1", "contact": "#f8eaea"}
EDGE = {"session": "#5b7aa8", "world": "#5f8a4c", "method": "#b7842f", "contact": "#b06060"}

missing = []


class Box:
    """A titled box: what happens, then the files that do it."""

    def __init__(self, kind, title, text, files, x=MARGIN, width=INNER):
        self.kind, self.title, self.text, self.files, self.x, self.width = kind, title, text, files, x, width
        missing.extend(name for name in files if not (SOURCES / name).is_file())
        rows = -(-len(files) // self.files_a_row)
        self.height = 32 + LINE * (len(text) + rows) + 5

    @property
    def files_a_row(self):
        return int(self.width // COLUMN)

    def draw(self, y):
        out = [f'<rect x="{self.x:.0f}" y="{y:.0f}" width="{self.width:.0f}" height="{self.height:.0f}" rx="6" '
               f'fill="{FILL[self.kind]}" stroke="{EDGE[self.kind]}"/>']
        at = y + 22
        out.append(label(self.x + 12, at, self.title, TITLE, weight="bold"))
        for line in self.text:
            at += LINE
            check_width(line, TEXT * 0.56, self.width - 20)
            out.append(label(self.x + 12, at, line, TEXT))
        step = (self.width - 12) / self.files_a_row
        for k, name in enumerate(self.files):
            column = k % self.files_a_row
            if column == 0:
                at += LINE
            check_width(name, FILE * 0.61, step - 8)
            out.append(label(self.x + 12 + column * step, at, name, FILE, family=MONO, colour="#3c4a5a"))
        return out


def label(x, y, text, size, family=SANS, colour="#1c242c", weight="normal", anchor="start"):
    return (f'<text x="{x:.0f}" y="{y:.0f}" font-family="{family}" font-size="{size}" font-weight="{weight}" '
            f'fill="{colour}" text-anchor="{anchor}">{escape(text)}</text>')


def check_width(text, advance, room):
    if len(text) * advance > room:
        sys.exit(f"tick.py: '{text}' needs about {len(text) * advance:.0f} px and has {room:.0f}")


def arrow(points, both=False):
    path = "M" + " L".join(f"{x:.0f} {y:.0f}" for x, y in points)
    start = ' marker-start="url(#tip)"' if both else ""
    return f'<path d="{path}" fill="none" stroke="#4a5560" stroke-width="1.5" marker-end="url(#tip)"{start}/>'


def column(k):
    return MARGIN + k * (COLUMN + GAP)


def draw():
    wide = 2 * COLUMN + GAP
    commands = Box("session", "apply commands", ["the events and commands due at this tick, recorded as they are applied"],
                   ["session/session.cpp", "world/command_executor.cpp"])
    tear = Box("world", "shrink and tear", ["burnt tissue contracts on",
                                            "if the scene says tearing: elements beyond the limit open a node (not in static solves)"],
               ["world/mesh_editor.cpp", "mesh/burn.cpp", "tools/tearing.cpp", "mesh/tear.cpp"])
    choose = Box("world", "choose method", ["the scene's integrator; auto: explicit where a cost model finds it fast enough, else implicit"],
                 ["world/method_choice.cpp", "world/step_cost.cpp"])
    methods = [
        Box("method", "explicit: substeps", ["as many as the stable step asks", "half step, forces, half step"],
            ["world/explicit_stepper.cpp", "world/stable_step.cpp", "elastic/body_forces.cpp"], column(0), COLUMN),
        Box("method", "implicit: stages", ["one step, halved if unconverged", "each stage minimises Φ by Newton"],
            ["world/implicit_stepper.cpp", "dynamics/implicit_stage.hpp", "dynamics/newton.cpp"], column(1), COLUMN),
        Box("method", "static: increments", ["of load; each minimises U", "halved where Newton fails"],
            ["world/static_stepper.cpp", "dynamics/static_solve.cpp", "dynamics/newton.cpp"], column(2), COLUMN)]
    contacts = [
        Box("contact", "contacts: impulses", ["in both halves of a substep"],
            ["tools/contact_impulses.cpp", "tools/self_contact_impulses.cpp"], column(0), COLUMN),
        Box("contact", "contacts: energy", ["part of Φ and U; solved again where contacts have changed"],
            ["tools/contact_potential.cpp", "tools/self_contact.cpp"], column(1), wide)]
    recovery = Box("world", "recovery", ["if the scene says recovery: a body that is inverted or unstable goes back to its last",
                                         "good state and is stepped as stable Neo-Hookean until it is valid again (not in static solves)"],
                   ["world/recovery_controller.cpp", "world/recovery_state.cpp", "world/recovery_surrogate.cpp"])
    publish = Box("session", "publish frame", ["an immutable frame, when the viewer has taken the last one"],
                  ["session/session.cpp", "session/frame.hpp", "session/surface_mesh.cpp"])

    out, y, between = [], 46.0, 26
    out.append(label(MARGIN, 28, "One tick", 18, weight="bold"))
    out.append(label(MARGIN + 90, 28, "world/typed_world.cpp", FILE, family=MONO, colour="#3c4a5a"))
    out.append(label(WIDTH - MARGIN, 28, "files below engine/heml/", SMALL, colour="#4a5560", anchor="end"))
    middle = WIDTH / 2
    for box in (commands, tear, choose):
        out += box.draw(y)
        y += box.height
        if box is not choose:
            out.append(arrow([(middle, y), (middle, y + between - 3)]))
            y += between
    fork = y + 14
    for k in range(3):
        x = column(k) + COLUMN / 2
        out.append(arrow([(middle, y), (middle, fork), (x, fork), (x, y + 37)] if k != 1 else [(middle, y), (middle, y + 37)]))
    y += 40
    loop_to = y + methods[0].height / 2
    for box in methods:
        out += box.draw(y)
    y += methods[0].height
    for k in range(3):
        x = column(k) + COLUMN / 2
        out.append(arrow([(x, y + 3), (x, y + 37)], both=True))
    y += 40
    contacts[1].height = contacts[0].height
    for box in contacts:
        out += box.draw(y)
    y += contacts[0].height
    join = y + 14
    for k in range(3):
        x = column(k) + COLUMN / 2
        if k != 1:
            out.append(f'<path d="M{x:.0f} {y:.0f} V{join:.0f} H{middle:.0f}" fill="none" stroke="#4a5560" stroke-width="1.5"/>')
    out.append(arrow([(middle, y), (middle, y + 37)]))
    y += 40
    out += recovery.draw(y)
    side = WIDTH - MARGIN / 2 + 6
    loop_from = y + recovery.height / 2
    out.append(arrow([(MARGIN + INNER, loop_from), (side, loop_from), (side, loop_to), (MARGIN + INNER + 3, loop_to)]))
    turn = (loop_from + loop_to) / 2
    out.append(f'<g transform="rotate(-90 {side - 8:.0f} {turn:.0f})">'
               + label(side - 8, turn, "until the tick is done", SMALL, colour="#4a5560", anchor="middle") + "</g>")
    y += recovery.height
    out.append(arrow([(middle, y), (middle, y + between - 3)]))
    y += between
    out += publish.draw(y)
    y += publish.height + 22
    marker = ('<defs><marker id="tip" viewBox="0 0 10 10" refX="8" refY="5" markerWidth="8" markerHeight="8" '
              'orient="auto-start-reverse"><path d="M0 0 L10 5 L0 10 z" fill="#4a5560"/></marker></defs>')
    head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{y:.0f}" viewBox="0 0 {WIDTH} {y:.0f}" role="img" '
            'aria-label="The phases of one tick and the file of each">')
    ground = f'<rect width="{WIDTH}" height="{y:.0f}" rx="8" fill="#ffffff" stroke="#d0d7de"/>'
    return "\n".join([head, marker, ground, *out, "</svg>"]) + "\n"


def main():
    (HERE / "tick.svg").write_text(draw(), encoding="utf-8")
    for name in missing:
        print(f"tick.py: there is no engine/heml/{name}", file=sys.stderr)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
