// The runs as cars in one world: as ghosts that drive together, or side by side, each in its own picture.
import type { LoadedDocument } from "../document";
import { Car, type CarPart } from "../scene/car";
import { openStage, type Stage } from "../scene/stage";
import type { Track } from "./track";

export type Together = "ghosts" | "side by side";

interface Actor {
  readonly car: Car;
  readonly track: Track;
  before: number; // its time in the last picture [s]
}

export class World {
  readonly stage: Stage | null;
  together: Together = "ghosts";
  private readonly actors: readonly Actor[];

  constructor(host: HTMLElement, loaded: LoadedDocument, tracks: readonly Track[]) {
    this.stage = openStage(host);
    this.actors = this.stage === null ? [] : actorsOf(tracks);
    const [first] = this.actors;
    if (this.stage === null || first === undefined) return;
    this.stage.setRoad(first.car.scene.road);
    for (const { car, track } of this.actors) {
      this.addTiles(loaded, track);
      this.stage.add(car);
    }
  }

  get tracks(): readonly Track[] {
    return this.actors.map(({ track }) => track);
  }
  get cars(): readonly Car[] {
    return this.actors.map(({ car }) => car);
  }

  // Puts every car where its run has it at the time sampled last.
  update(): void {
    for (let i = 0; i < this.actors.length; ++i) {
      const actor = this.actors[i]!;
      const { at, row } = actor.track;
      actor.car.update(row, Number.isNaN(actor.before) ? 0 : at - actor.before);
      actor.before = at;
    }
  }

  show(part: CarPart, on: boolean): void {
    for (const { car } of this.actors) car.show(part, on);
  }

  arrange(together: Together): void {
    this.together = together;
    const apart = together === "side by side";
    this.actors.forEach(({ car }, i) => car.setGhost(!apart && i > 0));
    this.stage?.split(apart ? this.cars : []);
  }

  // Roads of compared runs are one: tiles of any of them fill the gaps of the others.
  private addTiles(loaded: LoadedDocument, { run }: Track): void {
    for (const { ix, iy, column } of run.tiles) this.stage?.addTile({ ix, iy, heights: loaded.column(column) });
  }
}

function actorsOf(tracks: readonly Track[]): Actor[] {
  const several = tracks.length > 1;
  const actors = tracks.flatMap((track) => {
    const { scene } = track.run;
    if (scene === null) return [];
    const look = { series: several ? track.index : null, ghost: false };
    return [{ track, car: new Car(scene, track.channels, look), before: NaN }];
  });
  // Arrows compare only on one scale.
  const scale = Math.max(...actors.map(({ car }) => car.newtonsPerMeter));
  actors.forEach(({ car }, i) => {
    car.newtonsPerMeter = scale;
    car.setGhost(i > 0);
  });
  return actors;
}
