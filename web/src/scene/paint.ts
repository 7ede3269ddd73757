// Materials of one car, in the colors of the page.
import * as THREE from "three";
import { color, seriesColor } from "../theme";

export interface CarLook {
  readonly series: number | null; // of its color (theme.ts); null: plain
  readonly ghost: boolean; // translucent
}
export const plainLook: CarLook = { series: null, ghost: false };

const ghostOpacity = 0.42;

const metallic = (roughness: number, metalness: number): THREE.MeshStandardMaterial =>
  new THREE.MeshStandardMaterial({ roughness, metalness });

// Puts a coil's wire where its length wants it and keeps the wire round (shapes.ts).
function stretchable(material: THREE.MeshStandardMaterial): THREE.MeshStandardMaterial {
  material.onBeforeCompile = (shader) => {
    const stretch = "(length(instanceMatrix[2].xyz) / length(instanceMatrix[0].xyz))";
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nattribute float along;")
      .replace("#include <beginnormal_vertex>", `#include <beginnormal_vertex>\nobjectNormal.z *= ${stretch};`)
      .replace("#include <begin_vertex>", `vec3 transformed = vec3(position.xy, along + position.z / ${stretch});`);
  };
  return material;
}

// What shines like lacquer or glass shows the sky where it is seen at a low angle.
function reflecting(material: THREE.MeshLambertMaterial, share: number): THREE.MeshLambertMaterial {
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace("#include <opaque_fragment>", `
      vec3 toEye = normalize(vViewPosition);
      float mirrored = dot(reflect(-toEye, normal), mat3(viewMatrix) * vec3(0.0, 0.0, 1.0));
      float bright = smoothstep(-0.08, 0.12, mirrored) * (0.55 + 0.45 * clamp(mirrored, 0.0, 1.0));
      float grazing = 1.0 - abs(dot(normal, toEye));
      outgoingLight += ${share.toFixed(2)} * bright * (0.12 + 0.88 * grazing * grazing * grazing * grazing) * vec3(0.86, 0.92, 1.0);
      #include <opaque_fragment>`);
  };
  return material;
}

// Much of a picture is body: its light is the cheapest there is, and what shines adds the sky.
const bodyMaterial = (): THREE.MeshLambertMaterial => new THREE.MeshLambertMaterial({ side: THREE.DoubleSide });

// A shell that one sees through, and whose rounded edges show where it ends.
const glass = (): THREE.ShaderMaterial =>
  new THREE.ShaderMaterial({
    uniforms: { shade: { value: new THREE.Color() }, strength: { value: 1 } },
    vertexShader: `
      varying vec3 outward, away;
      void main() {
        vec4 view = modelViewMatrix * vec4(position, 1.0);
        outward = normalMatrix * normal;
        away = view.xyz;
        gl_Position = projectionMatrix * view;
      }`,
    fragmentShader: `
      varying vec3 outward, away;
      uniform vec3 shade;
      uniform float strength;
      void main() {
        float grazing = 1.0 - abs(dot(normalize(outward), normalize(away)));
        gl_FragColor = vec4(shade, strength * (0.05 + 0.34 * grazing * grazing * grazing));
        #include <colorspace_fragment>
      }`,
    transparent: true,
    depthWrite: false,
    side: THREE.DoubleSide,
  });

const shadedByVertex = (roughness: number, metalness: number): THREE.MeshStandardMaterial =>
  new THREE.MeshStandardMaterial({ roughness, metalness, vertexColors: true });

const overlay = (): THREE.MeshBasicMaterial =>
  new THREE.MeshBasicMaterial({ depthTest: false, depthWrite: false, transparent: true, opacity: 0.9, fog: false });

export class Paint {
  readonly metal = metallic(0.35, 0.55);
  readonly dark = metallic(0.5, 0.35);
  readonly carrier = metallic(0.45, 0.4);
  readonly spring = stretchable(metallic(0.4, 0.1));
  readonly rubber = shadedByVertex(0.9, 0);
  readonly rim = shadedByVertex(0.35, 0.5);
  readonly body = glass();
  readonly lacquer = reflecting(bodyMaterial(), 0.34);
  readonly boxWall = bodyMaterial();
  readonly window = reflecting(bodyMaterial(), 0.7);
  readonly trim = bodyMaterial();
  readonly headlamp = reflecting(bodyMaterial(), 0.5);
  readonly taillamp = reflecting(bodyMaterial(), 0.3);
  readonly unseen = new THREE.MeshBasicMaterial({ visible: false });
  readonly force = overlay();
  readonly friction = overlay();

  private readonly series: number | null;
  private ghost = false;

  constructor(look: CarLook) {
    this.rim.side = THREE.DoubleSide; // the barrel is seen from within
    this.series = look.series;
    this.setGhost(look.ghost);
  }

  // For the groups of a body's shape (bodies/surface.ts).
  bodywork(isBox: boolean): THREE.Material[] {
    return [isBox ? this.boxWall : this.lacquer, this.window, this.trim, this.headlamp, this.taillamp];
  }
  get outline(): THREE.Material[] {
    return [this.body, this.unseen, this.unseen, this.body, this.body];
  }

  setGhost(on: boolean): void {
    this.ghost = on;
    for (const material of this.solids) {
      material.transparent = on;
      material.opacity = on ? ghostOpacity : 1;
      material.needsUpdate = true;
    }
    this.force.opacity = this.friction.opacity = on ? 0.5 : 0.9;
    this.setTheme();
  }

  setTheme(): void {
    const { series, ghost } = this;
    const own = series === null ? null : seriesColor(series);
    const solid = (name: string): string => (ghost && own !== null ? own : color(name));
    this.metal.color.set(solid("metal"));
    this.dark.color.set(solid("metal")).multiplyScalar(0.45);
    this.carrier.color.set(solid("metal")).lerp(new THREE.Color(color("accent")), ghost ? 0 : 0.35);
    this.spring.color.set(solid("series-2"));
    this.rubber.color.set(solid("tire"));
    this.rim.color.set(solid("metal")).lerp(new THREE.Color(1, 1, 1), 0.35);
    this.lacquer.color.set(own ?? color("lacquer"));
    this.boxWall.color.set(ghost && own !== null ? own : color("box-wall"));
    this.window.color.set(color("window"));
    this.trim.color.set(color("trim"));
    this.headlamp.color.set(color("headlamp"));
    this.taillamp.color.set(color("taillamp"));
    (this.body.uniforms["shade"]!.value as THREE.Color).set(own ?? color("accent"));
    this.body.uniforms["strength"]!.value = ghost ? 0.6 : 1;
    this.force.color.set(ghost && own !== null ? own : color("series-3"));
    this.friction.color.set(ghost && own !== null ? own : color("series-4"));
  }

  dispose(): void {
    const others = [this.body, this.unseen, this.force, this.friction];
    for (const material of [...this.solids, ...others]) material.dispose();
  }

  private get solids(): readonly THREE.Material[] {
    const parts = [this.metal, this.dark, this.carrier, this.spring, this.rubber, this.rim];
    return [...parts, this.lacquer, this.boxWall, this.window, this.trim, this.headlamp, this.taillamp];
  }
}
