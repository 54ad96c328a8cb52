// The page begins here.

import { read_data } from "./data.js";
import { rows_needed } from "./surface.js";
import { Histogram } from "./Histogram.js";
import { Instrument } from "./Instrument.js";
import { follow_theme } from "./theme.js";
import { make_panel, make_reading } from "./panel.js";
import { listen_to_keys } from "./keyboard.js";

function start()
{
  const element = id => document.getElementById(id), note = element("note");
  const trial = document.createElement("canvas").getContext("webgl2");
  const is_too_large = data => rows_needed(data) > trial.getParameter(trial.MAX_TEXTURE_SIZE);
  const refuse = text => {
    note.textContent = text;
    element("figures").hidden = false;
  };
  if(! trial)
    return refuse("The pictures need WebGL 2, which this browser does not have, or which is switched off.");
  const data = read_data();
  if(data.number_of_faces === 0)
    return refuse("There are no triangles.");
  if(is_too_large(data))
    return refuse(`${data.number_of_faces} triangles are more than this graphics card takes.`);
  trial.getExtension("WEBGL_lose_context")?.loseContext();

  if(data.is_sphere)
  {
    const pane = element("layout");
    pane.querySelector("h2").textContent = "Sphere";
    pane.setAttribute("aria-label", pane.getAttribute("aria-label").replace("Layout. Arrows move it", "Sphere. Arrows turn it"));
  }
  const reading = make_reading(element("reading"));
  reading.show(null);
  const instrument = new Instrument(data, element("canvas"), element("surface"), element("layout"), reading);
  instrument.histogram = new Histogram(element("histogram"), element("histogram-text"), {}, band => instrument.set_band(band));
  follow_theme(instrument);
  const panel = make_panel(instrument);
  listen_to_keys(instrument, panel);
  element("canvas").addEventListener("webglcontextlost", () => { note.textContent = "The graphics card was lost. Please load the page again."; });
  new ResizeObserver(() => instrument.histogram.draw()).observe(element("histogram"));
  instrument.resize(); // draws
  note.textContent = "";
  globalThis.flatten_mesh_page = instrument; // for tests, and for the curious
}

// At once: frames and timers may never come where nobody looks, as in a window in the background, or in a browser that makes a picture of the page.
start();
