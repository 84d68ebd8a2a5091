// The replay in 3D: the mesh, the way of the haptic interface point, and one step with all about it.
import * as THREE from "three";
import { OrbitControls } from "orbit-controls";
import { Mesh, Series, Trace } from "./data";
import { linesOf } from "./outlines";
import type { Visited } from "./visits";
import { isDark, movesLittle, shade } from "./words";

/** Dark blue to yellow, rising in brightness too, so that it survives grey and colour blindness (cividis, few stops). */
const RAMP = [[0.0, 0.14, 0.3], [0.12, 0.22, 0.43], [0.34, 0.36, 0.44], [0.51, 0.49, 0.47], [0.7, 0.63, 0.44], [0.87, 0.78, 0.36], [1.0, 0.92, 0.27]];

function ramp(share: number): number[] {
  const at = Math.min(0.999, Math.max(0, share)) * (RAMP.length - 1), i = Math.floor(at), t = at - i;
  return RAMP[i].map((from, k) => from + (RAMP[i + 1][k] - from) * t);
}

/** As CSS, for a legend. */
export const rampAsCss = `linear-gradient(90deg, ${RAMP.map((one) => `rgb(${one.map((part) => Math.round(255 * part)).join(" ")})`).join(", ")})`;

export class Stage {
  readonly canvas: HTMLCanvasElement;
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(45, 1, 0.001, 100);
  private readonly orbit: OrbitControls;
  private readonly surface: THREE.Mesh;
  private readonly probe: THREE.Mesh;
  private readonly contact: THREE.Mesh;
  private readonly normal: THREE.ArrowHelper;
  private readonly reach: THREE.LineSegments | THREE.Line;
  private way: THREE.Line | null = null;
  private near: THREE.Mesh | null = null;
  private nearEdges: THREE.LineSegments | null = null;
  private nearest: THREE.Mesh | null = null;
  private answers: THREE.Object3D[] = [];
  private outlines: THREE.LineSegments[] = [];
  private readonly middle: number[];
  private readonly scale: number;
  private waiting = false;
  private flight = 0;

  constructor(private readonly mesh: Mesh, private readonly place: HTMLElement) {
    const { low, high, diagonal } = mesh.about;
    this.middle = low.map((one, k) => (one + high[k]) / 2);
    this.scale = diagonal > 0 ? 1 / diagonal : 1;
    this.renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.canvas = this.renderer.domElement;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    place.prepend(this.canvas);
    this.camera.position.set(0.5, 0.35, 1.15);
    this.orbit = new OrbitControls(this.camera, this.canvas);
    this.orbit.enableKeys = false;  // arrow keys go through steps
    this.orbit.addEventListener("change", () => this.draw());
    this.scene.add(new THREE.AmbientLight(0xffffff, 0.45));
    const sun = new THREE.DirectionalLight(0xffffff, 0.75);
    sun.position.set(0.6, 1, 0.8);
    this.scene.add(sun);
    this.surface = new THREE.Mesh(this.surfaceGeometry(), new THREE.MeshLambertMaterial({ color: 0xb8bcc4, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
    this.probe = new THREE.Mesh(new THREE.SphereBufferGeometry(1, 32, 20), new THREE.MeshLambertMaterial({ color: 0x2f7fd0, transparent: true, opacity: 0.45, depthWrite: false }));
    this.contact = new THREE.Mesh(new THREE.SphereBufferGeometry(1, 16, 12), new THREE.MeshBasicMaterial({ color: 0xd01c1c, depthTest: false }));
    this.normal = new THREE.ArrowHelper(new THREE.Vector3(0, 1, 0), new THREE.Vector3(), 0.05, 0xd01c1c);
    this.reach = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0xd01c1c }));
    this.contact.renderOrder = 4;
    for (const one of [this.reach, ...this.normal.children]) one.renderOrder = 2;
    this.probe.renderOrder = 3;
    this.scene.add(this.surface, this.probe, this.contact, this.normal, this.reach);
    new ResizeObserver(() => this.resize()).observe(place);
    this.resize();
  }

  private at(x: number, y: number, z: number): THREE.Vector3 {
    return new THREE.Vector3((x - this.middle[0]) * this.scale, (y - this.middle[1]) * this.scale, (z - this.middle[2]) * this.scale);
  }
  private of(array: ArrayLike<number>, i: number): THREE.Vector3 { return this.at(array[3 * i], array[3 * i + 1], array[3 * i + 2]); }

  private scaled(array: ArrayLike<number>): Float32Array {
    const result = new Float32Array(array.length);
    for (let i = 0; i < array.length; ++i) {
      const value = (array[i] - this.middle[i % 3]) * this.scale;
      result[i] = Number.isFinite(value) ? value : 0;
    }
    return result;
  }

  private surfaceGeometry(): THREE.BufferGeometry {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(this.scaled(this.mesh.vertices), 3));
    geometry.setIndex(new THREE.BufferAttribute(this.mesh.corners, 1));
    geometry.computeVertexNormals();
    return geometry;
  }

  private resize(): void {
    const width = Math.max(1, this.place.clientWidth), height = Math.max(1, this.place.clientHeight);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Once, before the next frame. */
  draw(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.renderer.render(this.scene, this.camera);
    });
  }

  /** The way of the trajectory, coloured by the contestant's time or by where it erred. */
  showWay(trace: Trace, series: Series | undefined, color: "time" | "error"): void {
    if (this.way) { this.scene.remove(this.way); this.way.geometry.dispose(); }
    const colors = new Float32Array(3 * trace.steps);
    const low = series ? Math.log(series.about.lowNs) : 0, high = series ? Math.log(series.about.highNs) : 1;
    // They differ in brightness, too, for whoever sees no red.
    const wrong = isDark() ? [1, 0.5, 0.45] : [0.55, 0, 0], right = isDark() ? [0.3, 0.33, 0.4] : [0.62, 0.66, 0.74];
    for (let step = 0; step < trace.steps; ++step) {
      const time = series?.ns[step] ?? NaN;
      let one = isDark() ? [0.45, 0.45, 0.5] : [0.6, 0.6, 0.65];
      if (color === "time" && time === time) one = ramp((Math.log(time) - low) / (high - low || 1));
      if (color === "error" && time === time) one = series!.charged[step] ? wrong : right;
      colors.set(one, 3 * step);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(this.scaled(trace.position), 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(colors, 3));
    const jumps = trace.name.startsWith("jump");
    this.way = jumps
      ? new THREE.Points(geometry, new THREE.PointsMaterial({ size: 2.5, sizeAttenuation: false, vertexColors: 2 })) as unknown as THREE.Line
      : new THREE.Line(geometry, new THREE.LineBasicMaterial({ vertexColors: 2 }));
    this.scene.add(this.way);
    this.draw();
  }

  /** Probe, contact and normal of a step; at a noted one also the triangles around and who answered otherwise. */
  showStep(trace: Trace, step: number, shown: Series[], colors: Map<string, string>): void {
    const noted = trace.notedAt.get(step), exact = noted === undefined ? null : trace.probe(noted);
    const center = exact ? this.at(exact.center[0], exact.center[1], exact.center[2]) : this.of(trace.position, step);
    const radius = (exact?.radius ?? trace.about.radius) * this.scale;
    const size = Math.max(radius, 0.002);
    this.probe.position.copy(center);
    this.probe.scale.set(size, size, size);
    const located = trace.known(step) && trace.about.query !== "sweep", found = trace.found(step);
    const point = this.of(trace.point, step);
    this.contact.visible = this.normal.visible = located && found;
    this.reach.visible = located;
    this.contact.position.copy(point);
    const mark = size * 0.12;
    this.contact.scale.set(mark, mark, mark);
    const direction = new THREE.Vector3().subVectors(center, point);
    if (direction.length() > 0) {
      this.normal.position.copy(point);
      this.normal.setDirection(direction.clone().normalize());
      this.normal.setLength(size * 1.6, size * 0.35, size * 0.2);
    }
    this.reach.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array([center.x, center.y, center.z, point.x, point.y, point.z]), 3));
    this.showNear(trace, noted, step);
    for (const one of this.answers) this.scene.remove(one);
    this.answers = [];
    for (const series of shown) {
      const answer = noted === undefined ? null : series.answer(noted);
      if (!answer || !series.charged[step] || series.found[step] !== 1) continue;
      const ball = new THREE.Mesh(new THREE.SphereBufferGeometry(size * 0.1, 12, 8), new THREE.MeshBasicMaterial({ color: shade(colors.get(series.name) ?? "#888888"), depthTest: false }));
      ball.position.copy(this.at(answer.point[0], answer.point[1], answer.point[2]));
      this.answers.push(ball);
      this.scene.add(ball);
    }
    this.draw();
  }

  /** Outlines of what a query looked at: strong where it looked inside, faint where it turned away. */
  showVisited(seen: Visited | null): void {
    for (const one of this.outlines) { this.scene.remove(one); one.geometry.dispose(); one.material.dispose(); }
    this.outlines = [];
    for (const { corners, color, opacity } of seen ? linesOf(seen, isDark()) : []) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(this.scaled(corners), 3));
      const lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color, opacity, transparent: true, depthTest: false }));
      lines.renderOrder = 5;
      this.outlines.push(lines);
      this.scene.add(lines);
    }
    this.draw();
  }

  private showNear(trace: Trace, noted: number | undefined, step: number): void {
    for (const old of [this.near, this.nearEdges, this.nearest]) if (old) { this.scene.remove(old); old.geometry.dispose(); }
    this.near = this.nearEdges = this.nearest = null;
    if (noted === undefined) return;
    const corners: number[] = [], edges: number[] = [], nearest: number[] = [];
    for (const triangle of trace.near(noted)) {
      const three = [0, 1, 2].map((k) => this.of(this.mesh.nearVertices, this.mesh.nearCorners[3 * triangle + k]));
      const flat = three.reduce<number[]>((all, v) => [...all, v.x, v.y, v.z], []);
      corners.push(...flat);
      for (let k = 0; k < 3; ++k) edges.push(...flat.slice(3 * k, 3 * k + 3), ...flat.slice(3 * ((k + 1) % 3), 3 * ((k + 1) % 3) + 3));
      if (this.mesh.nearIds[triangle] === trace.triangle[step]) nearest.push(...flat);
    }
    if (!corners.length) return;
    const geometry = (numbers: number[]) => {
      const made = new THREE.BufferGeometry();
      made.setAttribute("position", new THREE.BufferAttribute(new Float32Array(numbers), 3));
      return made;
    };
    const solid = geometry(corners);
    solid.computeVertexNormals();
    this.near = new THREE.Mesh(solid, new THREE.MeshLambertMaterial({ color: 0xe8d9b0, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
    this.nearEdges = new THREE.LineSegments(geometry(edges), new THREE.LineBasicMaterial({ color: 0x5b4a1e }));
    this.nearest = new THREE.Mesh(geometry(nearest), new THREE.MeshBasicMaterial({ color: 0xe07b00, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 0.5, polygonOffsetUnits: 0.5 }));
    // In front of the coarse surface, which is not where the mesh is.
    this.near.renderOrder = 1;
    this.near.onBeforeRender = (renderer) => renderer.clearDepth();
    this.nearEdges.renderOrder = this.nearest.renderOrder = 2;
    this.scene.add(this.near, this.nearEdges, this.nearest);
  }

  /** Moves the camera to the step, at once where motion is not wanted. */
  flyTo(trace: Trace, step: number): void {
    const target = this.of(trace.position, step), size = Math.max(trace.about.radius * this.scale, 0.004);
    const point = this.of(trace.point, step);
    const out = new THREE.Vector3().subVectors(target, point);
    if (!(out.length() > 0) || !trace.found(step)) out.copy(target);
    if (!(out.length() > 0)) out.set(0, 0, 1);
    out.normalize().add(new THREE.Vector3(0.35, 0.3, 0.35)).normalize().multiplyScalar(size * 9);
    const goal = target.clone().add(out), from = this.camera.position.clone(), before = this.orbit.target.clone();
    const start = performance.now(), length = movesLittle() ? 0 : 700, flight = ++this.flight;
    const move = (now: number) => {
      if (flight !== this.flight) return;
      const t = length ? Math.min(1, (now - start) / length) : 1, smooth = t * t * (3 - 2 * t);
      this.camera.position.copy(from).lerp(goal, smooth);
      this.orbit.target.copy(before).lerp(target, smooth);
      this.orbit.update();
      this.draw();
      if (t < 1) requestAnimationFrame(move);
    };
    move(start);
  }

  /** The whole mesh again. */
  home(): void {
    ++this.flight;
    this.camera.position.set(0.5, 0.35, 1.15);
    this.orbit.target.set(0, 0, 0);
    this.orbit.update();
    this.draw();
  }
}
