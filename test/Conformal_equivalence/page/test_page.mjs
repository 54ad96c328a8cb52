// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The page of flatten_mesh --html, as a browser shows it; see `run`.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { Browser, find_browser } from "./Browser.mjs";
import * as in_page from "./in_page.mjs";

const [program, option] = process.argv.slice(2);
const meshes = join(process.env.CGAL_DATA_DIR || "", "meshes"), here = dirname(fileURLToPath(import.meta.url));

function skip(reason)
{
  console.log(`SKIPPED: ${reason}`);
  process.exit(77);
}

if(! find_browser())
  skip("Chromium is not installed");
if(! existsSync(join(meshes, "bear.off")))
  skip("CGAL's meshes are not there (scripts/fetch_data)");

const folder = mkdtempSync(join(tmpdir(), "page_test_"));

function make_page(name, mesh, ...options)
{
  const file = join(folder, name + ".html");
  execFileSync(program, [join(meshes, mesh), "--html", file, "--quiet", ...options], { stdio: ["ignore", "ignore", "inherit"] });
  return file;
}

// What a page must never do.
const complaints = [];
function watch(browser)
{
  browser.on_event((method, p) => {
    if(method === "Runtime.exceptionThrown")
      complaints.push(p.exceptionDetails.exception?.description || p.exceptionDetails.text);
    if(method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(p.type))
      complaints.push(p.args.map(a => a.value || a.description).join(" "));
    // the browser itself says how it draws without a graphics card
    if(method === "Log.entryAdded" && ["error", "warning"].includes(p.entry.level) && ! /GL Driver Message|swiftshader|fallback/i.test(p.entry.text))
      complaints.push(p.entry.text);
    if(method === "Network.requestWillBeSent" && ! /^(file|data|blob|about):/.test(p.request.url))
      complaints.push(`asks for ${p.request.url}`);
  });
}

// Calls a function of in_page.mjs in the page, with values.
const ask = (browser, f, ...values) => browser.evaluate(`(${f})(...${JSON.stringify(values)})`);

async function open(browser, file)
{
  await browser.open(file);
  await ask(browser, in_page.started);
}

// ---- seams

// The colours on both sides of all seam edges are the same, for patterns of several sizes; they are not, if the pattern is moved by a fourth of a strip.
async function test_seams(browser, file, symmetry)
{
  await open(browser, file);
  for(const parts of [1, 2, 7])
  {
    const { samples, differing, light, dark } = await ask(browser, in_page.compare_seams, parts, 0);
    assert.equal(differing, 0, `symmetry ${symmetry}, ${parts} parts: ${differing} of ${samples} samples differ across seams`);
    assert(light > samples / 20 && dark > samples / 20, `symmetry ${symmetry}: ${light} light and ${dark} dark ones of ${samples} samples`);
  }
  const moved = await ask(browser, in_page.compare_seams, 1, .25);
  assert(moved.differing > moved.samples / 20, "a pattern that does not fit is not told apart");
  assert.equal(await ask(browser, in_page.symmetry), symmetry);
}

// ---- the instrument

async function test_pictures(browser)
{
  // what is sampled is what is drawn
  const { compared, differing } = await ask(browser, in_page.compare_with_picture);
  assert(compared > 30, `only ${compared} pixels compared`);
  assert(differing <= compared / 50, `${differing} of ${compared} pixels of the layout have another colour than its samples`);

  // what is found under a pixel is drawn there
  const found = await ask(browser, in_page.pick_everywhere);
  assert(found.hits > 30 && found.misses > 10, JSON.stringify(found));
  assert(found.largest_error < .75, `points under pixels are drawn up to ${found.largest_error} pixels away`);
}

async function middle_of(browser, id)
{
  return await ask(browser, in_page.middle_of, id);
}

async function test_links(browser)
{
  for(const [first, second] of [["surface", "layout"], ["layout", "surface"]])
  {
    const [x, y] = await middle_of(browser, first);
    await browser.mouse("mouseMoved", x, y);
    const hovered = await ask(browser, in_page.marks, "hovered");
    assert(hovered.face >= 0, `nothing is under the middle of the ${first}`);
    assert(Math.hypot(hovered[first][0], hovered[first][1]) < 1.5, `the mark is not under the cursor: ${hovered[first]}`);
    assert(hovered.is_shown[first] && hovered.is_shown[second]);
    assert.equal(hovered.reading.Triangle, hovered.number);
    await browser.click(x, y);
    await browser.mouse("mouseMoved", 5, 5);
    const fixed = await ask(browser, in_page.marks, "fixed");
    assert.equal(fixed.face, hovered.face);
    assert.equal((await ask(browser, in_page.marks, "hovered")).face, -1, "the mark stays without the cursor");
    assert.equal(fixed.reading.Triangle, hovered.number, "what is fixed is read");
    await browser.key("Escape");
    assert.equal((await ask(browser, in_page.marks, "fixed")).face, -1);
  }
  // a drag turns and does not fix
  const [x, y] = await middle_of(browser, "surface"), before = await ask(browser, in_page.camera, "surface");
  await browser.mouse("mousePressed", x, y, { button: "left", buttons: 1, clickCount: 1 });
  for(const step of [10, 30, 60])
    await browser.mouse("mouseMoved", x + step, y + step / 2, { button: "left", buttons: 1 });
  await browser.mouse("mouseReleased", x + 60, y + 30, { button: "left", clickCount: 1 });
  assert.notDeepEqual(await ask(browser, in_page.camera, "surface"), before);
  assert.equal((await ask(browser, in_page.marks, "fixed")).face, -1);
  await browser.mouse("mouseWheel", x, y, { deltaX: 0, deltaY: -200 });
  await browser.key("r");
  assert.deepEqual(await ask(browser, in_page.camera, "surface"), before, "reset leads back");
  // a tap fixes
  await browser.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [{ x, y }] });
  await browser.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  assert((await ask(browser, in_page.marks, "fixed")).face >= 0, "a tap fixes nothing");
  await browser.key("Escape");
}

async function test_keys(browser)
{
  await ask(browser, in_page.focus, "surface");
  const before = await ask(browser, in_page.camera, "surface");
  await browser.key("ArrowLeft");
  await browser.key("+");
  assert.notDeepEqual(await ask(browser, in_page.camera, "surface"), before);
  await browser.key("r");
  await browser.key("Enter");
  assert((await ask(browser, in_page.marks, "fixed")).face >= 0, "Enter fixes nothing");
  await browser.key("n");
  const cone = await ask(browser, in_page.marks, "fixed");
  assert.match(cone.reading.Cone, /^[0-9.]+\u00b0, vertex [0-9]+$/);
  assert(Math.hypot(...cone.surface) < 2 && Math.hypot(...cone.layout) < 2, "the cone is not in the middle");
  await browser.key("Escape");
  await browser.key("r");
  for(const [key, mode] of [["4", "quasi-conformal"], ["2", "u"], ["3", "area"]])
  {
    await browser.key(key);
    const state = await ask(browser, in_page.state);
    assert.equal(state.mode, mode);
    assert.equal(state.histogram_total, state.number_of_faces, "the histogram has all triangles");
    assert(state.range[0] < state.range[1]);
  }
}

// A range of the histogram is kept, and everything else is faded.
async function test_histogram(browser)
{
  const [x, y] = await middle_of(browser, "histogram"), all = await ask(browser, in_page.canvas_image);
  await browser.mouse("mouseMoved", x, y);
  const { band, range } = await ask(browser, in_page.state);
  assert(band[0] > range[0] && band[1] < range[1] && band[0] < band[1]);
  assert(await ask(browser, in_page.difference_from, all) > .02, "nothing is faded");
  await browser.mouse("mouseMoved", x, y - 200);
  assert(await ask(browser, in_page.difference_from, all) < .004, "something stays faded");
}

// Linear and projective interpolation differ in the surface's picture, and in what is under the cursor.
async function test_projective(browser)
{
  await browser.key("1");
  const projective = await ask(browser, in_page.canvas_image), [x, y] = await middle_of(browser, "surface");
  await browser.mouse("mouseMoved", x, y);
  const there = await ask(browser, in_page.layout_point);
  await browser.key("p");
  const difference = await ask(browser, in_page.difference_from, projective);
  assert(difference > 1e-5, `the pictures differ by ${difference}`);
  await browser.mouse("mouseMoved", x + 30, y);
  await browser.mouse("mouseMoved", x, y);
  assert.notDeepEqual(await ask(browser, in_page.layout_point), there);
  await browser.key("p");
  await browser.mouse("mouseMoved", 5, 5);
  assert(await ask(browser, in_page.difference_from, projective) < difference / 4);
}

// ---- what it looks like

async function compare_with_reference(browser, name)
{
  const file = join(here, name + ".png");
  if(option === "--write-references")
    return writeFileSync(file, Buffer.from((await ask(browser, in_page.canvas_image)).split(",")[1], "base64"));
  const difference = await ask(browser, in_page.difference_from, "data:image/png;base64," + readFileSync(file).toString("base64"));
  assert(difference < .02, `the picture differs from ${name}.png by ${difference} in the mean`);
}

async function test_places(browser)
{
  await browser.set_dark(true);
  assert(await ask(browser, in_page.corner_is_dark, true), "dark mode is not dark");
  await browser.set_dark(false);
  assert(await ask(browser, in_page.corner_is_dark, false), "light mode is not light");
  await browser.set_window(390, 800, 2, true);
  const phone = await ask(browser, in_page.fitting);
  assert(phone.overflow <= 0, `wider than a phone by ${phone.overflow}`);
  assert.equal(phone.pixels, 2 * phone.width, "not as sharp as the display");
  assert(phone.is_stacked, "the pictures are not one above the other");
  await browser.set_window(800, 560);
}

// The header keeps to one row where pictures are side by side.
async function test_header(browser)
{
  for(const width of [1400, 1000])
  {
    await browser.set_window(width, 700);
    const header = await ask(browser, in_page.header);
    assert.equal(header.toggles, 4, "a disk with cones and weights can show everything");
    assert(header.rows <= 2 && header.lines <= 2 && header.overflow <= 0, `at a width of ${width}: ${JSON.stringify(header)}`);
  }
  await browser.set_window(800, 560);
  await ask(browser, in_page.header); // when it has its size again
}

// The page is drawn when it is loaded, even if no frame, timer or observer ever comes.
async function test_drawn_at_once(browser, file)
{
  const never = "requestAnimationFrame = setTimeout = setInterval = queueMicrotask = () => 0; ResizeObserver = class { observe() {} };";
  const { identifier } = await browser.send("Page.addScriptToEvaluateOnNewDocument", { source: never });
  await browser.open(file);
  const { note, colors } = await ask(browser, in_page.drawn_at_once);
  await browser.send("Page.removeScriptToEvaluateOnNewDocument", { identifier });
  assert.equal(note, "");
  assert(colors > 10, `only ${colors} colours are drawn`);
}

async function test_sphere(browser, file)
{
  await open(browser, file);
  const found = await ask(browser, in_page.pick_everywhere);
  assert(found.hits > 30 && found.misses > 10, JSON.stringify(found));
  assert(found.largest_error < .75, `points under pixels are drawn up to ${found.largest_error} pixels away`);
  await test_links(browser);
  const [x, y] = await middle_of(browser, "layout"), lines = await ask(browser, in_page.canvas_image);
  await browser.mouse("mouseMoved", x, y);
  assert.match((await ask(browser, in_page.marks, "hovered")).reading["Latitude, longitude"], /^[^ ]+\u00b0, [^ ]+\u00b0$/);
  for(let i = 0; i < 4; ++i)
    await browser.key("]");
  assert(await ask(browser, in_page.difference_from, lines) > .002, "the lines do not change");
  await ask(browser, in_page.focus, "layout");
  const before = await ask(browser, in_page.camera, "layout");
  await browser.key("ArrowLeft");
  assert.notDeepEqual(await ask(browser, in_page.camera, "layout"), before);
  await browser.key("3");
  assert.equal((await ask(browser, in_page.state)).mode, "area");
}

async function test_without_graphics(browser, file)
{
  const { identifier } = await browser.send("Page.addScriptToEvaluateOnNewDocument", { source: "HTMLCanvasElement.prototype.getContext = () => null;" });
  await browser.open(file);
  const { note, figures } = await ask(browser, in_page.refusal);
  assert.match(note, /WebGL 2/);
  assert.match(figures, /quasi-conformal factor/);
  await browser.send("Page.removeScriptToEvaluateOnNewDocument", { identifier });
}

// ---- all of it

const lattices = [
  [4, "bear.off", "--cones", "auto=8"], [2, "lion-head.off", "--cones", "auto=5", "--quantize", "180"],
  [3, "lion-head.off", "--cones", "auto=5", "--quantize", "120"], [6, "lion-head.off", "--cones", "auto=5", "--quantize", "60"]
];
let browser;
const begin = Date.now();
const say = text => console.log(`${((Date.now() - begin) / 1000).toFixed(1)} s: ${text}`);
try
{
  browser = await Browser.start(find_browser()).catch(error => {
    console.log(`SKIPPED: the browser does not start: ${error.message}`);
    process.exit(77);
  });
  watch(browser);
  await browser.set_window(800, 560);
  const disk = make_page("disk", "nefertiti.off", "--cones", "auto=4", "--projective");
  say("a disk with cones");
  await open(browser, disk);
  await test_header(browser);
  await test_pictures(browser);
  const drawings = await ask(browser, in_page.drawings_of_search);
  assert(drawings <= 2, `triangles are drawn ${drawings} times for one picture that is searched`);
  await test_links(browser);
  await test_keys(browser);
  await test_histogram(browser);
  await test_projective(browser);
  await test_places(browser);
  say("references");
  await open(browser, make_page("reference", "lion-head.off"));
  await compare_with_reference(browser, "pattern");
  await browser.key("3");
  await compare_with_reference(browser, "area");
  say("without frames and timers");
  await test_drawn_at_once(browser, disk);
  say("a sphere");
  await test_sphere(browser, make_page("sphere", "bear.off", "--target", "sphere"));
  say("without WebGL");
  await test_without_graphics(browser, disk);
  for(const [symmetry, mesh, ...options] of lattices)
  {
    say(`seams of the lattice with symmetry ${symmetry}`);
    await test_seams(browser, make_page(`seamless_${symmetry}`, mesh, "--seamless", ...options), symmetry);
  }
  assert.deepEqual(complaints, []);
  say("done");
}
catch(error)
{
  console.log(error.stack);
  complaints.forEach(c => console.log(`the page: ${c}`));
  process.exitCode = 1;
}
finally
{
  await browser?.stop();
  rmSync(folder, { recursive: true, force: true });
}
