// What is used of the libraries, which bring no types of their own.

declare module "dygraphs" {
  export interface Options { [name: string]: unknown }
  export interface Point { xval: number; yval: number; name: string; canvasx: number; canvasy: number }
  export default class Dygraph {
    constructor(element: HTMLElement, data: (number | null)[][], options: Options);
    updateOptions(options: Options, blockRedraw?: boolean): void;
    destroy(): void;
    resize(): void;
    xAxisRange(): [number, number];
    toDomCoords(x: number, y: number): [number, number];
  }
}

declare module "three" {
  export class Vector3 {
    constructor(x?: number, y?: number, z?: number);
    x: number; y: number; z: number;
    set(x: number, y: number, z: number): this;
    copy(v: Vector3): this; clone(): Vector3; add(v: Vector3): this; sub(v: Vector3): this;
    multiplyScalar(s: number): this; length(): number; normalize(): this; lerp(v: Vector3, t: number): this;
    subVectors(a: Vector3, b: Vector3): this;
  }
  export class Color { constructor(color?: string | number); r: number; g: number; b: number; set(color: string | number): this; setHSL(h: number, s: number, l: number): this }
  export class Object3D { position: Vector3; scale: Vector3; visible: boolean; renderOrder: number; onBeforeRender: (renderer: WebGLRenderer) => void; add(...objects: Object3D[]): this; remove(...objects: Object3D[]): this; children: Object3D[] }
  export class Scene extends Object3D { background: Color | null }
  export class Camera extends Object3D { up: Vector3; lookAt(v: Vector3): void }
  export class PerspectiveCamera extends Camera { constructor(fov: number, aspect: number, near: number, far: number); aspect: number; near: number; far: number; updateProjectionMatrix(): void }
  export class BufferAttribute { constructor(array: ArrayLike<number>, size: number); needsUpdate: boolean; array: Float32Array }
  export class BufferGeometry { setAttribute(name: string, attribute: BufferAttribute): void; setIndex(index: BufferAttribute): void; computeVertexNormals(): void; dispose(): void; setDrawRange(start: number, count: number): void }
  export class SphereBufferGeometry extends BufferGeometry { constructor(radius: number, width: number, height: number) }
  export class Material { dispose(): void; color: Color; opacity: number }
  export class MeshLambertMaterial extends Material { constructor(options: object) }
  export class MeshBasicMaterial extends Material { constructor(options: object) }
  export class LineBasicMaterial extends Material { constructor(options: object) }
  export class PointsMaterial extends Material { constructor(options: object) }
  export class Mesh extends Object3D { constructor(geometry: BufferGeometry, material: Material); geometry: BufferGeometry; material: Material }
  export class Line extends Object3D { constructor(geometry: BufferGeometry, material: Material); geometry: BufferGeometry; material: Material }
  export class LineSegments extends Line {}
  export class Points extends Object3D { constructor(geometry: BufferGeometry, material: Material); geometry: BufferGeometry; material: Material }
  export class ArrowHelper extends Object3D { constructor(direction: Vector3, origin: Vector3, length: number, color: number | string); setDirection(d: Vector3): void; setLength(length: number, head?: number, width?: number): void; setColor(color: Color): void }
  export class AmbientLight extends Object3D { constructor(color: number, intensity: number) }
  export class DirectionalLight extends Object3D { constructor(color: number, intensity: number) }
  export class WebGLRenderer {
    constructor(options: object); domElement: HTMLCanvasElement;
    clearDepth(): void; setPixelRatio(ratio: number): void; setSize(width: number, height: number, style?: boolean): void; render(scene: Scene, camera: Camera): void; dispose(): void;
  }
  export const DoubleSide: number;
}

declare module "orbit-controls" {
  import { Camera, Vector3 } from "three";
  export class OrbitControls {
    constructor(camera: Camera, element: HTMLElement);
    target: Vector3; enableKeys: boolean; screenSpacePanning: boolean;
    update(): void; addEventListener(name: string, listener: () => void): void;
  }
}
