// The controls around the pictures.

import { modes } from "./Instrument.js";

const element = id => document.getElementById(id);

function labelled_input(parent, type, name, value, label, title)
{
  const box = document.createElement("label"), input = document.createElement("input");
  Object.assign(input, { type, name, value });
  box.title = title;
  box.append(input, label);
  parent.append(box);
  return input;
}

// What is known of the place under the cursor.
export function make_reading(list)
{
  const hint = () => {
    const div = document.createElement("div"), text = document.createElement("dt");
    div.className = "hint";
    text.textContent = "Point at a picture";
    div.append(text);
    return div;
  };
  return {
    show(lines)
    {
      list.replaceChildren(...(lines ? lines.map(([name, value]) => {
        const div = document.createElement("div"), dt = document.createElement("dt"), dd = document.createElement("dd");
        div.classList.toggle("wide", name === "Surface"); // three numbers
        dt.textContent = name;
        dd.textContent = dd.title = value;
        div.append(dt, dd);
        return div;
      }) : [hint()]));
    }
  };
}

function add_modes(instrument)
{
  const names = { "pattern": "Pattern", "u": "u", "area": "Area", "quasi-conformal": "Quasi-conformal" };
  const inputs = modes.map((mode, i) => {
    const input = labelled_input(element("modes"), "radio", "mode", mode, names[mode], `Key ${i + 1}`);
    input.addEventListener("change", () => choose(mode));
    return input;
  });
  const choose = mode => {
    inputs[modes.indexOf(mode)].checked = true;
    element("pattern-tool").hidden = mode !== "pattern";
    element("histogram-tool").hidden = mode === "pattern";
    instrument.set_mode(mode);
  };
  choose(instrument.data.mode);
  return choose;
}

function add_toggles(instrument)
{
  const { data } = instrument, toggles = {};
  const add = (name, key, label, is_possible, is_on, set) => {
    if(! is_possible)
      return;
    const input = toggles[key] = labelled_input(element("toggles"), "checkbox", name, name, label, `Key ${key}`);
    input.checked = is_on;
    input.addEventListener("change", () => set(input.checked));
    set(is_on);
  };
  // a seamless layout is to be seen without its seams, and interpolated linearly, as textures are
  add("seams", "s", "Seams", data.seams.length, ! data.symmetry, x => instrument.set_layer("seams", x));
  add("cones", "c", "Cones", data.cones.length, true, x => instrument.set_layer("cones", x));
  add("wireframe", "w", "Edges", true, false, x => instrument.set_wire(x));
  add("projective", "p", "Projective", data.has_weights, ! data.symmetry, x => instrument.set_projective(x));
  return key => { if(toggles[key]) toggles[key].click(); };
}

function add_pattern_slider(instrument)
{
  const slider = element("pattern-size"), text = element("pattern-text");
  const set = size => {
    slider.value = Math.max(0, Math.min(1, size));
    text.textContent = instrument.set_pattern_size(Number(slider.value));
    slider.setAttribute("aria-valuetext", text.textContent);
  };
  slider.step = .01;
  slider.addEventListener("input", () => set(Number(slider.value)));
  set(instrument.first_pattern_size());
  return step => set(Number(slider.value) + step);
}

// Each button of an axis shows one side and then the other.
function add_presets(instrument)
{
  const add = (view, id, label, title, action) => {
    const button = document.createElement("button");
    Object.assign(button, { type: "button", textContent: label, title });
    button.setAttribute("aria-label", title);
    button.addEventListener("click", action);
    for(const type of ["pointerdown", "pointerup", "dblclick"]) // no drag of the picture
      button.addEventListener(type, e => e.stopPropagation());
    element(id).append(button);
  };
  const pairs = { x: ["right", "left"], y: ["top", "bottom"], z: ["front", "back"] };
  let last = "";
  const along = axis => instrument.surface.reset(last = pairs[axis][0] === last ? pairs[axis][1] : pairs[axis][0]);
  for(const axis in pairs)
    add(instrument.surface, "surface-presets", axis, `Surface from ${pairs[axis].join(" or ")} (${axis})`, () => along(axis));
  const reset = view => { last = ""; view.reset(); };
  add(instrument.surface, "surface-presets", "Reset", "Reset the view of the surface (r)", () => reset(instrument.surface));
  add(instrument.layout, "layout-presets", "Reset", "Reset the view of the layout (r)", () => reset(instrument.layout));
  return { along, reset };
}

function add_figures()
{
  const button = element("figures-button"), panel = element("figures");
  const toggle = is_open => {
    panel.hidden = ! is_open;
    button.setAttribute("aria-expanded", String(is_open));
  };
  button.addEventListener("click", () => toggle(panel.hidden));
  toggle(matchMedia("(min-width: 84rem), (max-width: 46rem), (orientation: portrait)").matches);
  return () => toggle(panel.hidden);
}

export function make_panel(instrument)
{
  element("help-button").addEventListener("click", () => element("help").showModal());
  return {
    choose_mode: add_modes(instrument), toggle: add_toggles(instrument), step_pattern: add_pattern_slider(instrument),
    presets: add_presets(instrument), toggle_figures: add_figures(), show_help: () => element("help").showModal()
  };
}
