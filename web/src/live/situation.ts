// Words for where the page stands.
import type { LinkState } from "./link";
import type { Status } from "../contract";
import type { Role } from "./session";

export interface Situation {
  readonly title: string; // "": nothing to say
  readonly text: string;
  readonly dims: boolean; // the picture behind is not of now
}

const nothing: Situation = { title: "", text: "", dims: false };

function linkSituation(state: LinkState, given: boolean): Situation {
  if (state === "connecting") return { title: "Connecting…", text: "", dims: true };
  if (state === "refused") {
    return {
      title: "This address is no longer valid",
      text: "The program was started anew. Open the address that it has printed.",
      dims: true,
    };
  }
  if (!given) return { title: "Connection lost", text: "Trying again…", dims: true };
  return {
    title: "The program has ended",
    text: "Start hamilcar drive again and open the address that it prints.",
    dims: true,
  };
}

// given: the loss lasts for so long that the program is given up.
export function situation(state: LinkState, given: boolean, status: Status | null, role: Role): Situation {
  if (state !== "open") return linkSituation(state, given);
  const drives = role === "driver";
  const dims = false;
  switch (status?.paused) {
    case "ended":
      return { title: status.ended || "The run has ended", text: drives ? "Press Enter to start again." : "", dims };
    case "driver":
      return { title: "Paused", text: drives ? "Press P to go on." : "", dims };
    case "nobody":
      return { title: "Nobody drives", text: "The car waits. Press a driving key or take the wheel.", dims };
    default:
      return nothing;
  }
}

export function roleText(status: Status | null, role: Role): string {
  if (!status) return "";
  if (role === "driver") return "You drive";
  return role === "nobody" ? "Nobody drives" : `Page ${status.driver} drives, you watch`;
}
