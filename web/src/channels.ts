// Channels by what they are: by role and by what they belong to, never by a name taken apart.
import type { Channel, ChannelRole, DisplayUnit } from "./contract";

// What only the picture needs, and few people read.
const ofThePicture: ReadonlySet<ChannelRole | undefined> = new Set<ChannelRole>([
  "pose_x", "pose_y", "pose_z", "pose_qw", "pose_qx", "pose_qy", "pose_qz",
  "contact_x", "contact_y", "contact_z", "ground_force_x", "ground_force_y", "ground_force_z",
]);
export const isMotion = ({ role }: Channel): boolean => ofThePicture.has(role);

// As people read it: 27.8 m/s are 100 km/h.
export const displayOf = ({ unit, display }: Channel): DisplayUnit => display ?? { unit, factor: 1 };

export class Channels {
  private readonly byName: ReadonlyMap<string, number>;
  private readonly byRole: ReadonlyMap<string, number>;

  constructor(readonly list: readonly Channel[]) {
    this.byName = new Map(list.map(({ name }, i) => [name, i]));
    const known = list.flatMap(({ role, of = "" }, i) => (role === undefined ? [] : [[`${role} ${of}`, i] as const]));
    this.byRole = new Map(known);
  }

  // Where a row has it; -1: nowhere.
  named(name: string): number {
    return this.byName.get(name) ?? -1;
  }
  find(role: ChannelRole, of = ""): number {
    return this.byRole.get(`${role} ${of}`) ?? -1;
  }
}
