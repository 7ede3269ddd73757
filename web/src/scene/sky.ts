// Sky and light: a soft gradient from the haze at the horizon upward, one sun, light from all of the sky.
import * as THREE from "three";
import { color } from "../theme";
import { hazeDistance } from "./ground";

export class Sky {
  readonly root = new THREE.Group();
  readonly haze = new THREE.FogExp2(0xffffff, 1 / hazeDistance);
  private readonly uniforms = {
    horizon: { value: new THREE.Color() },
    zenith: { value: new THREE.Color() },
    glow: { value: new THREE.Color() },
  };
  private readonly dome: THREE.Mesh<THREE.SphereGeometry, THREE.ShaderMaterial>;
  private readonly fromSky = new THREE.HemisphereLight(0xffffff, 0xffffff, 1);
  private readonly sun = new THREE.DirectionalLight(0xffffff, 1);
  private readonly fill = new THREE.DirectionalLight(0xffffff, 1);

  constructor() {
    this.dome = new THREE.Mesh(
      new THREE.SphereGeometry(1, 24, 16),
      new THREE.ShaderMaterial({
        uniforms: this.uniforms,
        vertexShader: `
          varying vec3 direction;
          void main() {
            direction = position;
            gl_Position = projectionMatrix * vec4(mat3(viewMatrix) * position, 1.0);
          }`,
        fragmentShader: `
          varying vec3 direction;
          uniform vec3 horizon, zenith, glow;
          void main() {
            float height = clamp(normalize(direction).z, 0.0, 1.0);
            vec3 sky = mix(horizon, zenith, smoothstep(0.0, 0.55, height));
            float toSun = max(dot(normalize(direction), normalize(vec3(-4.5, 3.5, 8.0))), 0.0);
            float halo = toSun * toSun * toSun;
            gl_FragColor = vec4(sky + glow * 0.25 * halo * halo * halo, 1.0);
            #include <colorspace_fragment>
          }`,
        side: THREE.BackSide,
        depthTest: false,
        depthWrite: false,
      }),
    );
    this.dome.frustumCulled = false;
    this.dome.renderOrder = -20;
    this.sun.position.set(-4.5, 3.5, 8);
    this.fill.position.set(5, -4, 1.5);
    this.root.add(this.dome, this.fromSky, this.sun, this.fill);
    this.setTheme();
  }

  setTheme(): void {
    const horizon = new THREE.Color(color("sky"));
    const dark = horizon.getHSL({ h: 0, s: 0, l: 0 }).l < 0.5;
    this.uniforms.horizon.value.copy(horizon);
    this.uniforms.zenith.value.set(color("zenith"));
    this.uniforms.glow.value.set(0xfff4dd).multiplyScalar(dark ? 0.06 : 1);
    this.haze.color.copy(horizon);
    this.fromSky.color.set(dark ? 0xcfdcec : 0xffffff);
    this.fromSky.groundColor.set(color("ground"));
    this.fromSky.intensity = dark ? 1.5 : 1.9;
    this.sun.intensity = dark ? 1.7 : 2.4;
    this.fill.intensity = dark ? 0.7 : 0.8;
  }

  dispose(): void {
    this.dome.geometry.dispose();
    this.dome.material.dispose();
  }
}
