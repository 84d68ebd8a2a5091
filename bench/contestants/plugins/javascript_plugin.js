// Runs the user's module for a worker: the other end of bench/contestants/plugins/script_process.h. It holds nothing newer
// than ES2018, so that a node that is too old can say so.
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
const NO_TRIANGLE = 2 ** 32 - 1;
const LONGEST_READ = 2 ** 30;
const QUESTIONS_A_TURN = 4096;

const message = new ArrayBuffer(72);
const bytes = new Uint8Array(message), number = new Uint32Array(message, 4, 1), values = new Float64Array(message, 8, 8);
const detectors = new Map();
let plugin = null;
let doing = ""; // stands before what is thrown

// Where in the module, as far as the stack tells.
function place_of(error) {
  const found = String(error && error.stack).split(`${ADDRESS}:`)[1];
  return found ? ` (${path.basename(FILE)}, line ${parseInt(found, 10)})` : "";
}

// What was thrown, in one line.
function described(error) {
  const has_message = error !== null && typeof error === "object" && typeof error.message === "string";
  const text = has_message ? `${error.name || "Error"}: ${error.message}` : `thrown: ${inspect(error, { depth: 0 })}`;
  return (text.replace(/: $/, "") + place_of(error)).split(/\s+/).join(" ");
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
  const tail = Buffer.from(text);
  bytes[0] = code;
  if (tail.length > 0) number[0] = tail.length;
  const all = tail.length > 0 ? Buffer.concat([Buffer.from(message), tail]) : bytes;
  for (let at = 0; at < all.length;) at += fs.writeSync(CHANNEL, all, at);
}

function fail(error) {
  send(FAILED, Buffer.from(doing + described(error)).slice(0, 900));
}

async function loaded() {
  if (parseInt(process.versions.node, 10) < OLDEST_NODE) {
    throw new Error(`the node in PATH is ${process.versions.node}, and a plug-in in JavaScript needs ${OLDEST_NODE} or newer: `
      + "apt-get install nodejs");
  }
  const module = await import(ADDRESS);
  if (typeof module.build !== "function") throw new TypeError("it exports no function build, which docs/plugins.md asks for");
  return module;
}

// The first vertices and triangles are those of a cube: which queries there are is known once something is built.
async function describe() {
  plugin = plugin || await loaded();
  const word = (name, otherwise) => {
    const value = plugin[name] === undefined ? otherwise : plugin[name];
    if (typeof value !== "string") throw new TypeError(`${name} is a ${typeof value}; it must be a string`);
    return value.trim().split(/\s+/).join(" ");
  };
  const words = [word("name", path.parse(FILE).name), word("summary", "a plug-in in JavaScript"), word("guarantee", "approximate")];
  doing = "build, tried with a cube: ";
  const cube = await built(new Float64Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1]),
    new Uint32Array([0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5]));
  const queries = Object.values(QUERIES).filter((query) => typeof cube[query] === "function");
  release(cube);
  doing = "";
  return [...words, queries.join(" ")].join("\n");
}

async function built(vertices, triangles) {
  const detector = await plugin.build(vertices, triangles);
  if (detector === null || typeof detector !== "object") {
    throw new TypeError(`build returned ${inspect(detector, { depth: 0 })}; it must return an object with the queries`);
  }
  return detector;
}

function release(detector) {
  if (typeof detector.destroy === "function") detector.destroy();
}

function mesh() {
  const counts = receive(new BigUint64Array(2));
  return [receive(new Float64Array(3 * Number(counts[0]))), receive(new Uint32Array(3 * Number(counts[1])))];
}

function real(query, what, value) {
  if (typeof value !== "number") throw new TypeError(`${query} returned a ${what} that is ${inspect(value)}; it must be a number`);
  return value;
}

function put_vector(query, what, value, at) {
  if (!(Array.isArray(value) || ArrayBuffer.isView(value)) || value.length !== 3) {
    throw new TypeError(`${query} returned a ${what} that is ${inspect(value, { depth: 0 })}; it must hold 3 numbers`);
  }
  for (let k = 0; k < 3; ++k) values[at + k] = real(query, what, value[k]);
}

function put_contact(query, found) {
  if (found === null) return NO;
  if (typeof found !== "object") {
    const members = `${query === "first_hit" ? "fraction, " : ""}point, normal, distance, triangle`;
    throw new TypeError(`${query} returned ${inspect(found)}; it must return null or {${members}}`);
  }
  const triangle = found.triangle === null || found.triangle === undefined ? NO_TRIANGLE : found.triangle;
  if (!Number.isInteger(triangle) || triangle < 0 || triangle > NO_TRIANGLE) {
    throw new TypeError(`${query} returned the triangle ${inspect(triangle)}; it must be the number of one, or null`);
  }
  put_vector(query, "point", found.point, 0);
  put_vector(query, "normal", found.normal, 3);
  values[6] = real(query, "distance", found.distance);
  values[7] = query === "first_hit" ? real(query, "fraction", found.fraction) : 0;
  number[0] = triangle;
  return YES;
}

function asked(code) {
  const query = QUERIES[code], detector = detectors.get(number[0]), at = values.slice(0, 3);
  const found = code === FIRST_HIT ? detector.first_hit(at, values.slice(3, 6), values[6]) : detector[query](at, values[3]);
  if (found !== null && typeof found === "object" && typeof found.then === "function") {
    throw new TypeError(`${query} returned a promise; it must return its answer`);
  }
  if (code !== TOUCHES) return put_contact(query, found);
  if (typeof found !== "boolean") throw new TypeError(`touches returned ${inspect(found)}; it must return true or false`);
  return found ? YES : NO;
}

async function reproduced() {
  const query = QUERIES[number[0]], [from, to] = [Array.from(values.slice(0, 3)), Array.from(values.slice(3, 6))];
  const questions = {
    touches: { query, center: from, radius: values[3] },
    nearest: { query, center: from, reach: values[3] },
    first_hit: { query, from, to, radius: values[6] },
  };
  const [vertices, triangles] = mesh();
  const text = plugin.reproduce === undefined ? "" : await plugin.reproduce(vertices, triangles, questions[query]);
  if (typeof text !== "string") throw new TypeError(`reproduce returned ${inspect(text, { depth: 0 })}; it must return a string`);
  number[0] = 0;
  return text;
}

async function answer() {
  switch (bytes[0]) {
    case NOTHING:
      return send(NO, "");
    case DESCRIBE:
      return send(YES, await describe());
    case BUILD: {
      const which = number[0], detector = await built(...mesh());
      detectors.set(which, detector);
      values.fill(0);
      values[0] = Number(detector.nbytes || 0);
      values[1] = Number(detector.error || 0);
      return send(YES, "");
    }
    case DESTROY:
      release(detectors.get(number[0]));
      detectors.delete(number[0]);
      return send(YES, "");
    case REPRODUCE:
      return send(YES, await reproduced());
    default:
      return send(asked(bytes[0]), "");
  }
}

// What is thrown where nobody waits for it, and a promise that nobody keeps, end an answer that is being waited for.
process.on("uncaughtException", (error) => {
  fail(error);
  process.exit(1);
});
process.on("beforeExit", () => {
  fail(new Error("a promise is never settled"));
  process.exit(1);
});

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
