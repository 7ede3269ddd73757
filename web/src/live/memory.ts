// What the page remembers from one visit to the next. A browser may forbid that; then it remembers nothing.

export function remember(name: string, value: unknown): void {
  try {
    localStorage.setItem(`hamilcar.${name}`, JSON.stringify(value));
  } catch {
    return;
  }
}

export function recall(name: string): unknown {
  try {
    return JSON.parse(localStorage.getItem(`hamilcar.${name}`) ?? "null");
  } catch {
    return null;
  }
}
