// Runs the user's module for a worker: the other end of bench/contestants/plugins/script_plugin.cpp. It holds nothing
// newer than ES2018, so that a node that is too old can say so.
"use strict";
const fs = require("fs");
const path = require("path");
const { inspect } = require("util");

const FILE = process.argv[1], CHANNEL = Number(process.argv[2]);
const ADDRESS = require("url").pathToFileURL(FILE).href;
const OLDEST_NODE = 18;
const [DESCRIBE, BUILD, DESTROY, TOUCHES, NEAREST, FIRST_HIT, NOTHING, REPRODUCE] = [0, 1, 2, 3, 4, 5, 6, 7];
const [NO, YES, FAILED] = [0, 1, 2];
const QUERIES = { [TOUCHES]: "touches", [NEAREST]: "nearest", [FIRST_HIT]: "first_hit" };
const CUBE = [
  new Float64Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1]),
  new Uint32Array([0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5]),
];
const NO_TRIANGLE = 2 ** 32 - 1;
const LONGEST_READ = 2 ** 30;
const QUESTIONS_A_TURN = 4096;

const message = new ArrayBuffer(72);
const bytes = new Uint8Array(message), number = new Uint32Array(message, 4, 1);
const values = new Float64Array(message, 8, 8);
const detectors = new Map();
let plugin = null;
let doing = ""; // stands before what is thrown

// Where node cannot parse the module: it shows the line to a terminal, and keeps it from whoever imports.
function unparsed_line() {
  const { stderr } = require("child_process").spawnSync(process.execPath, ["--check", FILE], { encoding: "utf-8" });
  return (/^.*:(\d+)$/m.exec(stderr) || [])[1];
}

// What was thrown, in one line, and where in the module.
function described(error) {
  const is_error = error !== null && typeof error === "object" && typeof error.message === "string";
  const text = is_error ? `${error.name || "Error"}: ${error.message}` : `thrown: ${inspect(error, { depth: 0 })}`;
  const in_stack = String(is_error && error.stack).split(`${ADDRESS}:`)[1];
  const line = parseInt(in_stack || (plugin === null && error instanceof SyntaxError ? unparsed_line() : ""), 10);
  const place = line > 0 ? ` (${path.basename(FILE)}, line ${line})` : "";
  return (doing + text.replace(/: $/, "") + place).split(/\s+/).join(" ");
}

function receive(view) {
  const into = new Uint8Array(view.buffer, view.byteOffset, view.byteLength);
  for (let at = 0; at < into.length;) {
    const got = fs.readSync(CHANNEL, into, at, Math.min(into.length - at, LONGEST_READ), null);
    if (got === 0) process.exit(0); // the worker has ended
    at += got;
  }
  return view;
}

function send(code, text) {
  bytes[0] = code;
  if (text !== undefined) number[0] = text.length;
  const all = text === undefined ? bytes : Buffer.concat([bytes, text]);
  for (let at = 0; at < all.length;) at += fs.writeSync(CHANNEL, all, at);
}

function fail(error) {
  send(FAILED, Buffer.from(described(error)).slice(0, 900));
}

// Throws what says that something is not what docs/plugins.md asks for.
function refuse(what, value, must) {
  throw new TypeError(`${what} ${inspect(value, { depth: 0 })}; it must ${must}`);
}

async function load() {
  const { node } = process.versions;
  if (parseInt(node, 10) < OLDEST_NODE) {
    throw new Error(`the node in PATH is ${node}; a plug-in in JavaScript needs ${OLDEST_NODE} or newer: `
      + "apt-get install nodejs");
  }
  plugin = await import(ADDRESS);
  if (typeof plugin.build !== "function") {
    throw new TypeError("it exports no function build, which docs/plugins.md asks for");
  }
}

async function build(vertices, triangles) {
  const detector = await plugin.build(vertices, triangles);
  if (detector === null || typeof detector !== "object") {
    refuse("build returned", detector, "return an object with the queries");
  }
  return detector;
}

function destroy(detector) {
  if (typeof detector.destroy === "function") detector.destroy();
}

function word(name, otherwise) {
  const value = plugin[name] === undefined ? otherwise : plugin[name];
  if (typeof value !== "string") refuse(`${name} is`, value, "be a string");
  return value.trim().split(/\s+/).join(" ");
}

// Which queries there are is known once something is built.
async function describe() {
  if (plugin === null) await load();
  const name = word("name", path.parse(FILE).name), summary = word("summary", "a plug-in in JavaScript");
  const guarantee = word("guarantee", "approximate");
  doing = "build, tried with a cube: ";
  const cube = await build(...CUBE);
  const queries = Object.values(QUERIES).filter((query) => typeof cube[query] === "function");
  destroy(cube);
  doing = "";
  return [name, summary, guarantee, queries.join(" ")].join("\n");
}

function mesh() {
  const counts = receive(new BigUint64Array(2));
  return [receive(new Float64Array(3 * Number(counts[0]))), receive(new Uint32Array(3 * Number(counts[1])))];
}

function put_number(what, value, at) {
  if (typeof value !== "number") refuse(what, value, "be a number");
  values[at] = value;
}

function put_vector(what, value, at) {
  if (!(Array.isArray(value) || ArrayBuffer.isView(value)) || value.length !== 3) refuse(what, value, "hold 3 numbers");
  for (let k = 0; k < 3; ++k) put_number(what, value[k], at + k);
}

function put_contact(query, found) {
  if (found === null) return NO;
  if (typeof found !== "object") {
    const fraction = query === "first_hit" ? "fraction, " : "";
    refuse(`${query} returned`, found, `return null or {${fraction}point, normal, distance, triangle}`);
  }
  const triangle = found.triangle === null || found.triangle === undefined ? NO_TRIANGLE : found.triangle;
  if (!Number.isInteger(triangle) || triangle < 0 || triangle > NO_TRIANGLE) {
    refuse(`${query} returned the triangle`, triangle, "be the number of one, or null");
  }
  number[0] = triangle;
  put_vector(`${query} returned the point`, found.point, 0);
  put_vector(`${query} returned the normal`, found.normal, 3);
  put_number(`${query} returned the distance`, found.distance, 6);
  if (query === "first_hit") put_number("first_hit returned the fraction", found.fraction, 7);
  return YES;
}

function ask(code) {
  const query = QUERIES[code], detector = detectors.get(number[0]), at = values.slice(0, 3);
  const found = code === FIRST_HIT
    ? detector.first_hit(at, values.slice(3, 6), values[6])
    : detector[query](at, values[3]);
  if (found !== null && typeof found === "object" && typeof found.then === "function") {
    throw new TypeError(`${query} returned a promise; it must return its answer`);
  }
  if (code !== TOUCHES) return put_contact(query, found);
  if (typeof found !== "boolean") refuse("touches returned", found, "return true or false");
  return found ? YES : NO;
}

// The text of a script that shows an answer in the engine's own API, or nothing where the module cannot say.
async function reproduce() {
  const query = QUERIES[number[0]], [from, to] = [Array.from(values.slice(0, 3)), Array.from(values.slice(3, 6))];
  const question = {
    touches: { query, center: from, radius: values[3] },
    nearest: { query, center: from, reach: values[3] },
    first_hit: { query, from, to, radius: values[6] },
  }[query];
  const [vertices, triangles] = mesh();
  const text = plugin.reproduce === undefined ? "" : await plugin.reproduce(vertices, triangles, question);
  if (typeof text !== "string") refuse("reproduce returned", text, "return a string");
  return text;
}

async function answer() {
  switch (bytes[0]) {
    case NOTHING:
      return send(NO);
    case DESCRIBE:
      return send(YES, Buffer.from(await describe()));
    case BUILD: {
      const which = number[0], detector = await build(...mesh());
      detectors.set(which, detector);
      values[0] = Number(detector.nbytes || 0);
      values[1] = Number(detector.error || 0);
      return send(YES);
    }
    case DESTROY:
      destroy(detectors.get(number[0]));
      detectors.delete(number[0]);
      return send(YES);
    case REPRODUCE:
      return send(YES, Buffer.from(await reproduce()));
    default:
      return send(ask(bytes[0]));
  }
}

// What is thrown where nobody waits for it, and a promise that nobody keeps, end the answer that is waited for.
function end(error) {
  fail(error);
  process.exit(1);
}
process.on("uncaughtException", end);
process.on("beforeExit", () => end(new Error("a promise is never settled")));

async function serve() {
  for (let questions = 1; ; ++questions) {
    receive(bytes);
    // Engines in WebAssembly free what was forgotten in a turn of the event loop, which no question brings about.
    if (questions % QUESTIONS_A_TURN === 0) await new Promise(setImmediate);
    try {
      await answer();
    } catch (error) {
      fail(error);
    }
  }
}

serve();
