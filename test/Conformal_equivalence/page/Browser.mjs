// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A headless Chromium, driven by the DevTools protocol over a pipe: so nothing but node and the browser is needed.

import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { pathToFileURL } from "node:url";

// The program, or nothing.
export function find_browser()
{
  if(process.env.CHROMIUM)
    return process.env.CHROMIUM;
  const names = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];
  return (process.env.PATH || "").split(delimiter).flatMap(folder => names.map(name => join(folder, name))).find(existsSync);
}

export class Browser
{
  static async start(program, flags = [])
  {
    const browser = new Browser();
    browser.profile = mkdtempSync(join(tmpdir(), "page_test_"));
    browser.process = spawn(program, [
      "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--remote-debugging-pipe",
      "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-default-apps", "--disable-extensions",
      "--disable-sync", "--hide-scrollbars", "--mute-audio", "--force-color-profile=srgb", `--user-data-dir=${browser.profile}`, ...flags, "about:blank"
    ], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    browser.ended = new Promise(resolve => browser.process.on("exit", resolve));
    browser.ended.then(() => browser.fail_all(new Error("the browser has ended")));
    browser.process.on("error", error => browser.fail_all(error));
    browser.process.stdio[3].on("error", () => {}); // of a browser that has ended
    browser.answers = new Map();
    browser.number = 0;
    browser.listeners = [];
    let rest = "";
    browser.process.stdio[4].setEncoding("utf8").on("data", text => {
      const messages = (rest + text).split("\0");
      rest = messages.pop();
      messages.forEach(message => browser.receive(JSON.parse(message)));
    });
    const { targetInfos } = await browser.send("Target.getTargets");
    const { targetId } = targetInfos.find(t => t.type === "page");
    browser.session = (await browser.send("Target.attachToTarget", { targetId, flatten: true })).sessionId;
    for(const domain of ["Page", "Runtime", "Log", "Network"])
      await browser.send(domain + ".enable");
    return browser;
  }

  fail_all(error)
  {
    for(const { reject } of this.answers?.values() || [])
      reject(error);
    this.answers?.clear();
  }

  receive(message)
  {
    if(message.id === undefined)
      return this.listeners.forEach(listener => listener(message));
    const answer = this.answers.get(message.id);
    this.answers.delete(message.id);
    if(message.error)
      answer.reject(new Error(`${answer.method}: ${message.error.message}`));
    else
      answer.resolve(message.result);
  }

  send(method, params = {})
  {
    const id = ++this.number;
    return new Promise((resolve, reject) => {
      this.answers.set(id, { resolve, reject, method });
      this.process.stdio[3].write(JSON.stringify({ id, method, params, sessionId: this.session }) + "\0");
    });
  }

  // Calls `listener(method, params)` for every event.
  on_event(listener)
  {
    this.listeners.push(({ method, params }) => listener(method, params));
  }

  async open(file)
  {
    const loaded = new Promise(resolve => this.on_event(method => { if(method === "Page.loadEventFired") resolve(); }));
    await this.send("Page.navigate", { url: pathToFileURL(file).href });
    await loaded;
  }

  // The value of an expression, which may be a promise.
  async evaluate(expression)
  {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if(exceptionDetails)
      throw new Error(exceptionDetails.exception?.description || exceptionDetails.text);
    return result.value;
  }

  async set_window(width, height, deviceScaleFactor = 1, mobile = false)
  {
    await this.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor, mobile });
  }

  async set_dark(is_dark)
  {
    await this.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: is_dark ? "dark" : "light" }] });
  }

  async mouse(type, x, y, more = {})
  {
    await this.send("Input.dispatchMouseEvent", { type, x, y, ...more });
  }

  async click(x, y)
  {
    await this.mouse("mousePressed", x, y, { button: "left", buttons: 1, clickCount: 1 });
    await this.mouse("mouseReleased", x, y, { button: "left", clickCount: 1 });
  }

  async key(key, code = key)
  {
    const text = key.length === 1 ? key : key === "Enter" ? "\r" : undefined;
    await this.send("Input.dispatchKeyEvent", { type: text ? "keyDown" : "rawKeyDown", key, code, text });
    await this.send("Input.dispatchKeyEvent", { type: "keyUp", key, code });
  }

  // A PNG image.
  async screenshot()
  {
    return Buffer.from((await this.send("Page.captureScreenshot", { format: "png" })).data, "base64");
  }

  async stop()
  {
    if(this.process.exitCode === null)
    {
      await Promise.race([this.send("Browser.close").catch(() => {}), this.ended]);
      const late = setTimeout(() => this.process.kill("SIGKILL"), 3000);
      await this.ended;
      clearTimeout(late);
    }
    rmSync(this.profile, { recursive: true, force: true, maxRetries: 5 });
  }
}
