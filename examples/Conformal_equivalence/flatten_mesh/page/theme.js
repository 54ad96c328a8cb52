// Colours come from the style sheet, so that light and dark are chosen there.

import * as THREE from "three";
import { shader_color } from "./surface.js";

function variable(name)
{
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

export function apply_theme(instrument)
{
  const { uniforms, cone_uniforms, renderer, views, histogram, data } = instrument;
  const color = name => shader_color(variable(name));
  const values = { board_light: "--board-light", board_dark: "--board-dark", accent: "--accent", over: "--over", under: "--under", none: "--quiet", back: "--back",
                   flipped: "--flipped", ground: "--stage", ink: "--ink" };
  for(const name in values)
    uniforms[name].value.copy(color(values[name]));
  cone_uniforms.inside.value.copy(color("--cone"));
  cone_uniforms.rim.value.copy(color("--stage"));
  renderer.setClearColor(new THREE.Color().setStyle(variable("--stage")), 1);
  for(const view of views)
    for(const name of ["border", "circles", "cut"])
      if(view.layers[name])
        view.layers[name].material.color.setStyle(variable("--ink"));
  const stops = data.scale.map(c => shader_color(c));
  histogram.palette = {
    over: variable("--over"), under: variable("--under"), ink: variable("--ink"),
    at(t)
    {
      const i = Math.min(7, Math.floor(8 * t)), c = stops[i].clone().lerp(stops[i + 1], 8 * t - i);
      return `rgb(${c.toArray().map(x => Math.round(255 * x)).join()})`;
    }
  };
  histogram.draw();
  instrument.redraw();
}

export function follow_theme(instrument)
{
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => apply_theme(instrument));
  apply_theme(instrument);
}
