// The 3D view of particles. With three.js a bundle of its own (build.mjs), loaded by views/orbit.tsx.

import {
  BufferAttribute, BufferGeometry, Color, GridHelper, PerspectiveCamera, Points, Scene, ShaderMaterial, Spherical, Vector3, WebGLRenderer,
} from "three";
import {OrbitControls} from "three/addons/controls/OrbitControls.js";
import type {Cloud} from "./media/ply";

// Viridis at nine places, between them linear.
const ramp = ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"].map((hex) => new Color(hex));
const materialColors = ["#4c9be8", "#f28e2b", "#59a14f", "#e15759", "#b07aa1", "#edc948", "#76b7b2", "#9c755f"].map((hex) => new Color(hex));

const vertexShader = `
  attribute vec3 tint;
  uniform float diameter;  // m
  uniform float pixels;    // of the view's height, over twice the tangent of half its angle
  varying vec3 color;
  void main() {
    vec4 place = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * place;
    gl_PointSize = clamp(diameter * pixels / max(-place.z, 1e-9), 1.5, 64.0);
    color = tint;
  }`;
// Small balls, lit from the upper left.
const fragmentShader = `
  varying vec3 color;
  void main() {
    vec2 at = 2.0 * gl_PointCoord - 1.0;
    float square = dot(at, at);
    if (square > 1.0) discard;
    vec3 normal = vec3(at.x, -at.y, sqrt(1.0 - square));
    float light = 0.45 + 0.55 * max(0.0, dot(normal, normalize(vec3(-0.4, 0.6, 0.7))));
    gl_FragColor = vec4(color * light, 1.0);
    #include <colorspace_fragment>
  }`;

export class OrbitScene {
  private readonly renderer = new WebGLRenderer({antialias: true, alpha: true});
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(35, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private readonly geometry = new BufferGeometry();
  private readonly material = new ShaderMaterial({
    vertexShader, fragmentShader, uniforms: {diameter: {value: 0.01}, pixels: {value: 500}},
  });
  private readonly sized: ResizeObserver;
  private grid: GridHelper | null = null;
  private shown: {cloud: Cloud; color: string; size: number; range: [number, number] | null} | null = null;
  private readonly center = new Vector3();
  private radius = 0;
  private distance = 0;  // between neighbouring points, roughly
  private asked = 0;

  constructor(private readonly place: HTMLElement) {
    place.append(this.renderer.domElement);
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    const points = new Points(this.geometry, this.material);
    points.frustumCulled = false;
    this.scene.add(points);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());
    this.sized = new ResizeObserver(() => this.resize());
    this.sized.observe(place);
    this.resize();
  }

  /** Draws the points; returns the range of the colours, null where they stand for materials. */
  show(cloud: Cloud, color: string, size: number): [number, number] | null {
    const {shown} = this;
    if (shown && shown.cloud === cloud && shown.color === color && shown.size === size) return shown.range;
    if (shown?.cloud !== cloud) {
      this.geometry.setAttribute("position", new BufferAttribute(cloud.positions, 3));
      this.measure(cloud);
      if (!shown) this.reset();
    }
    const range = shown?.cloud === cloud && shown.color === color ? shown.range : this.paint(cloud, color);
    this.material.uniforms.diameter.value = 1.25 * size * this.distance;
    this.shown = {cloud, color, size, range};
    this.draw();
    return range;
  }

  /** Whether the key was one of the view's. */
  key(key: string): boolean {
    const turn: Record<string, [number, number]> = {
      ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1],
    };
    if (key in turn) this.turn(...turn[key]);
    else if (key === "+" || key === "=") this.turn(0, 0, 0.87);
    else if (key === "-") this.turn(0, 0, 1.15);
    else if (key === "0") this.reset();
    else return false;
    return true;
  }

  dispose() {
    cancelAnimationFrame(this.asked);
    this.sized.disconnect();
    this.controls.dispose();
    this.geometry.dispose();
    this.material.dispose();
    this.grid?.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.renderer.domElement.remove();
  }

  private measure(cloud: Cloud) {
    this.geometry.computeBoundingBox();
    const box = this.geometry.boundingBox!;
    if (cloud.kept === 0 || this.radius > 0) return;
    box.getCenter(this.center);
    const extent = box.getSize(new Vector3());
    this.radius = Math.max(1e-6, 0.5 * extent.length());
    // As far apart as the points of a lattice that fills the box.
    const flat = extent.z < 1e-9;
    this.distance = flat ? Math.sqrt((extent.x * extent.y) / cloud.kept) : Math.cbrt((extent.x * extent.y * extent.z) / cloud.kept);
    if (!(this.distance > 0)) this.distance = this.radius / 50;
    const side = 10 ** Math.ceil(Math.log10(4 * this.radius));
    this.grid = new GridHelper(side, 20, 0x888888, 0x888888);
    this.grid.position.set(this.center.x, box.min.y, this.center.z);
    for (const material of [this.grid.material].flat()) {
      material.transparent = true;
      material.opacity = 0.25;
      material.depthWrite = false;
    }
    this.scene.add(this.grid);
  }

  private reset() {
    const away = (1.25 * this.radius) / Math.sin((Math.PI / 180) * 0.5 * this.camera.fov);
    this.camera.near = away / 100;
    this.camera.far = away * 20;
    this.controls.target.copy(this.center);
    this.camera.position.copy(this.center).add(new Vector3(0.45, 0.35, 1).normalize().multiplyScalar(away));
    this.controls.update();
    this.resize();
  }

  private turn(sideways: number, up: number, closer = 1) {
    const from = new Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target));
    from.theta += sideways;
    from.phi = Math.min(Math.PI - 0.01, Math.max(0.01, from.phi + up));
    from.radius *= closer;
    this.camera.position.setFromSpherical(from).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  private paint(cloud: Cloud, color: string): [number, number] | null {
    const tints = new Float32Array(3 * cloud.kept);
    const scalar = cloud.scalars.find(({name}) => name === color);
    let range: [number, number] | null = null;
    const mixed = new Color();
    if (scalar) {
      let [least, most] = [Infinity, -Infinity];
      for (const value of scalar.values) {
        if (!Number.isFinite(value)) continue;
        least = Math.min(least, value);
        most = Math.max(most, value);
      }
      if (least > most) [least, most] = [0, 0];
      range = [least, most];
      for (let i = 0; i < cloud.kept; ++i) {
        const share = most > least ? (scalar.values[i] - least) / (most - least) : 0;
        const at = Math.min(1, Math.max(0, Number.isFinite(share) ? share : 0)) * (ramp.length - 1);
        const below = Math.min(ramp.length - 2, Math.floor(at));
        mixed.lerpColors(ramp[below], ramp[below + 1], at - below).toArray(tints, 3 * i);
      }
    } else {
      for (let i = 0; i < cloud.kept; ++i) materialColors[cloud.material[i] % materialColors.length].toArray(tints, 3 * i);
    }
    this.geometry.setAttribute("tint", new BufferAttribute(tints, 3));
    return range;
  }

  private resize() {
    const {clientWidth: width, clientHeight: height} = this.place;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.material.uniforms.pixels.value =
      (height * this.renderer.getPixelRatio()) / (2 * Math.tan((Math.PI / 360) * this.camera.fov));
    this.draw();
  }

  private draw() {
    cancelAnimationFrame(this.asked);
    this.asked = requestAnimationFrame(() => this.renderer.render(this.scene, this.camera));
  }
}
