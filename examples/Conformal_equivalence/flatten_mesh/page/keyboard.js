// Everything can be done by keys.

import { modes } from "./Instrument.js";

const keys = [
  ["1 2 3 4", "pattern, u, area factor, quasi-conformal factor"], ["s c w p", "seams, cones, edges, projective interpolation"],
  ["[ ]", "smaller and larger pattern"], ["x y z", "the surface along an axis; again: from the other side"], ["r", "reset both pictures"],
  ["Tab", "go from one control or picture to the next; in a picture:"], ["arrows", "turn the surface, move the layout"], ["+ \u2212", "zoom"],
  ["Enter", "fix what is in the middle"], ["n N", "next and previous cone"], ["g", "bring what is fixed into the middle of both"],
  ["Escape", "unfix"], ["f", "figures"],
  ["mouse", "drag turns or moves, right button moves, wheel zooms; a click fixes, a double click centres both pictures"],
  ["touch", "one finger turns or moves, two zoom; a tap fixes"]
];

export function listen_to_keys(instrument, panel)
{
  document.getElementById("help-keys").append(...keys.map(([key, text]) => {
    const row = document.createElement("tr"), kbd = document.createElement("kbd");
    kbd.textContent = key;
    row.insertCell().append(kbd);
    row.insertCell().textContent = text;
    return row;
  }));

  for(const view of instrument.views)
    view.element.addEventListener("keydown", e => {
      const fine = e.shiftKey ? .01 : .06;
      const steps = { ArrowLeft: [-fine, 0], ArrowRight: [fine, 0], ArrowUp: [0, fine], ArrowDown: [0, -fine] };
      if(e.target !== view.element || e.ctrlKey || e.metaKey || e.altKey)
        return;
      if(steps[e.key])
        view.step(...steps[e.key]);
      else if(e.key === "+" || e.key === "=")
        view.zoom(1.25);
      else if(e.key === "-")
        view.zoom(.8);
      else if(e.key === "Enter" || e.key === " ")
        instrument.fix(instrument.find(view, { x: view.element.clientWidth / 2, y: view.element.clientHeight / 2 }));
      else
        return;
      e.preventDefault();
    });

  const actions = {
    "[": () => panel.step_pattern(-.05), "]": () => panel.step_pattern(.05), "r": () => instrument.views.forEach(panel.presets.reset),
    "n": () => instrument.show_cone(1), "N": () => instrument.show_cone(-1), "g": () => instrument.show_fixed(),
    "Escape": () => instrument.fix(null), "f": panel.toggle_figures, "?": panel.show_help
  };
  modes.forEach((mode, i) => { actions[i + 1] = () => panel.choose_mode(mode); });
  for(const key of ["s", "c", "w", "p"])
    actions[key] = () => panel.toggle(key);
  for(const axis of ["x", "y", "z"])
    actions[axis] = () => panel.presets.along(axis);
  document.addEventListener("keydown", e => {
    if(e.ctrlKey || e.metaKey || e.altKey || document.getElementById("help").open || ! actions[e.key])
      return;
    actions[e.key]();
    e.preventDefault();
  });
}
