// What the road is painted with: a grid of 1 m and 10 m that fades before it flickers, tinted patches of other
// friction, haze toward the horizon. One shader for the even plane and for tiles of an uneven road.
import * as THREE from "three";
import type { RoadScene } from "../contract";
import { color } from "../theme";

export const hazeDistance = 260; // [m]

const vertexShader = `
  varying vec2 vGrid;
  varying vec2 vGround;
  varying vec3 vView;
  varying vec2 vSlope;
  #ifdef TILE
    attribute vec3 relief; // height, slopes along x and y
  #else
    uniform vec2 slope;
  #endif
  void main() {
    vec3 at = position;
    #ifdef TILE
      at.z = relief.x;
      vSlope = relief.yz;
    #else
      at.z += dot(slope, at.xy);
      vSlope = slope;
    #endif
    // Meshes lie at whole meters: their remainder by 100 m is exact, however far they are.
    vGrid = at.xy + mod(modelMatrix[3].xy, 100.0);
    vGround = (modelMatrix * vec4(at, 1.0)).xy;
    vec4 view = modelViewMatrix * vec4(at, 1.0);
    vView = view.xyz;
    gl_Position = projectionMatrix * view;
  }`;

// Lines of a grid as Ben Golus draws them: never thinner than a pixel, but fainter instead.
const fragmentShader = `
  varying vec2 vGrid;
  varying vec2 vGround;
  varying vec3 vView;
  varying vec2 vSlope;
  uniform vec3 base, line, haze, slick, grippy;
  uniform sampler2D grain;
  #if PATCHES > 0
    uniform vec4 patches[PATCHES]; // x, y low, x, y high
    uniform float grips[PATCHES]; // against the road's own
  #endif

  float grid(vec2 at, float width) {
    vec2 wide = fwidth(at);
    vec2 drawn = clamp(vec2(width), wide, vec2(0.5));
    vec2 away = 1.0 - abs(fract(at) * 2.0 - 1.0);
    vec2 one = smoothstep(drawn + 1.5 * wide, drawn - 1.5 * wide, away) * clamp(width / drawn, 0.0, 1.0);
    one = mix(one, vec2(width), clamp(wide * 2.0 - 1.0, 0.0, 1.0));
    return mix(one.x, 1.0, one.y);
  }

  void main() {
    float chippings = texture2D(grain, vGrid * 0.5).r - 0.5; // its mipmaps fade before it flickers
    float wear = texture2D(grain, vGrid * 0.01).r - 0.5;
    vec3 paint = base * (1.0 + 0.2 * chippings + 0.16 * wear);
    #if PATCHES > 0
      for (int i = 0; i < PATCHES; ++i) {
        vec2 soft = max(fwidth(vGround), vec2(1e-4));
        vec2 low = smoothstep(-soft, soft, vGround - patches[i].xy);
        vec2 high = smoothstep(-soft, soft, patches[i].zw - vGround);
        float inside = low.x * low.y * high.x * high.y;
        paint = mix(paint, grips[i] < 1.0 ? slick : grippy, inside * clamp(abs(log2(grips[i])) * 0.6, 0.25, 0.9));
      }
    #endif
    vec3 up = normalize(vec3(-vSlope, 1.0));
    paint *= 1.0 + 1.6 * (dot(up, vec3(-0.45, 0.35, 0.82)) - 0.82);
    float lines = max(grid(vGrid, 0.018) * 0.3, grid(vGrid * 0.1, 0.005) * 0.8);
    paint = mix(paint, line, lines);
    float far = length(vView) / ${hazeDistance.toFixed(1)};
    gl_FragColor = vec4(mix(haze, paint, exp(-far * far)), 1.0);
    #include <colorspace_fragment>
  }`;

const names = { base: "road", line: "ground-line", haze: "sky", grippy: "asphalt" } as const;
const hue = { h: 0, s: 0, l: 0 };

// Nearly as light as the ground, so that a patch lies in it and not on it.
function slickShade(out: THREE.Color): void {
  out.set(color("accent")).getHSL(hue);
  const { h, s } = hue;
  out.set(color("road")).getHSL(hue);
  out.setHSL(h, 0.36 * s, THREE.MathUtils.lerp(hue.l, 0.5, 0.2));
}

// Asphalt: gray noise of fine and coarse grains that repeats without a seam. 100 m of wear and 2 m of chippings divide 100 m.
function makeGrain(): THREE.DataTexture {
  const size = 128;
  const bytes = new Uint8Array(size * size);
  let seed = 1;
  const random = (): number => (seed = (seed * 16807) % 2147483647) / 2147483647;
  const layer = (cells: number): Float32Array => Float32Array.from({ length: cells * cells }, random);
  const layers = [[128, 0.5], [32, 0.3], [8, 0.2]].map(([cells = 1, share = 0]) => ({ cells, share, values: layer(cells) }));
  const smooth = (t: number): number => t * t * (3 - 2 * t);
  for (let i = 0; i < bytes.length; ++i) {
    let sum = 0;
    for (const { cells, share, values } of layers) {
      const [x, y] = [((i % size) * cells) / size, (Math.floor(i / size) * cells) / size];
      const [cx, cy] = [Math.floor(x), Math.floor(y)];
      const [tx, ty] = [smooth(x - cx), smooth(y - cy)];
      const at = (dx: number, dy: number): number => values[((cy + dy) % cells) * cells + ((cx + dx) % cells)] ?? 0;
      sum += share * ((at(0, 0) * (1 - tx) + at(1, 0) * tx) * (1 - ty) + (at(0, 1) * (1 - tx) + at(1, 1) * tx) * ty);
    }
    bytes[i] = 255 * sum;
  }
  const texture = new THREE.DataTexture(bytes, size, size, THREE.RedFormat);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.magFilter = THREE.LinearFilter;
  texture.minFilter = THREE.LinearMipmapNearestFilter;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  return texture;
}
let grain: THREE.DataTexture | null = null; // of all roads

export class GroundPaint {
  readonly plane: THREE.ShaderMaterial;
  readonly tile: THREE.ShaderMaterial;
  private readonly uniforms: Record<string, THREE.IUniform>;

  constructor(road: RoadScene) {
    this.uniforms = {
      grain: { value: (grain ??= makeGrain()) },
      slope: { value: new THREE.Vector2(road.grade, road.bank) },
      patches: { value: road.patches.map(({ x, y }) => new THREE.Vector4(x[0], y[0], x[1], y[1])) },
      grips: { value: road.patches.map(({ friction }) => Math.max(friction / (road.friction || 1), 0.05)) },
    };
    for (const key of [...Object.keys(names), "slick"]) this.uniforms[key] = { value: new THREE.Color() };
    const PATCHES = road.patches.length;
    const shared = { uniforms: this.uniforms, vertexShader, fragmentShader };
    this.plane = new THREE.ShaderMaterial({ ...shared, defines: { PATCHES } });
    this.tile = new THREE.ShaderMaterial({ ...shared, defines: { PATCHES, TILE: "" } });
    this.setTheme();
  }

  setTheme(): void {
    for (const [key, name] of Object.entries(names)) (this.uniforms[key]!.value as THREE.Color).set(color(name));
    slickShade(this.uniforms["slick"]!.value as THREE.Color);
  }

  dispose(): void {
    this.plane.dispose();
    this.tile.dispose();
  }
}
