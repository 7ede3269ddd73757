// The document that stands in a page, with its numbers. What it says is contract.ts, made from schemas/page.schema.json.
import type { ColumnReference, PageDocument } from "./contract";

// A square patch of an uneven road, read.
export interface RoadTile {
  readonly ix: number;
  readonly iy: number;
  readonly heights: ArrayLike<number>; // above z = 0 [m]
}

// The document of this page with its block of bytes; null where the page stands alone (hamilcar drive serves it so).
export interface LoadedDocument {
  readonly document: PageDocument;
  column(reference: ColumnReference): Float64Array | Float32Array;
}

function bytesOf(base64: string): ArrayBuffer {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

export function loadDocument(page: Document): LoadedDocument | null {
  const source = page.getElementById("hamilcar-document")?.textContent?.trim() ?? "";
  if (source === "") return null;
  const block = bytesOf(page.getElementById("hamilcar-columns")?.textContent?.trim() ?? "");
  return {
    document: JSON.parse(source) as PageDocument,
    column: ({ type, offset, count }) =>
      type === "f64" ? new Float64Array(block, offset, count) : new Float32Array(block, offset, count),
  };
}
