// Numbers and units as people read them: few digits, the same for all of one axis or column, a true minus sign.
import { roundOff } from "../contract";

const raised = "⁰¹²³⁴⁵⁶⁷⁸⁹";
const signed = (text: string): string => text.replace("-", "−");

// 1.5e-7 as 1.5·10⁻⁷, 1e-7 as 10⁻⁷.
export function power(value: number, decimals?: number): string {
  const [mantissa = "", exponent = ""] = value.toExponential(decimals).split("e");
  const digits = [...exponent.replace("+", "")].map((c) => (c === "-" ? "⁻" : raised[Number(c)])).join("");
  return Math.abs(Number(mantissa)) === 1 ? `${value < 0 ? "−" : ""}10${digits}` : `${signed(mantissa)}·10${digits}`;
}

// Zeros keep no minus.
export function fixed(value: number, decimals: number): string {
  const text = value.toFixed(decimals);
  return signed(Number(text) === 0 ? text.replace("-", "") : text);
}

const magnitude = (value: number): number => Math.floor(Math.log10(Math.abs(value)) + 1e-9);
const readable = (value: number): boolean => value === 0 || (Math.abs(value) >= 1e-4 && Math.abs(value) < 1e7);

export function significant(value: number, digits = 4): string {
  if (Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value < 0 ? "−∞" : "∞";
  if (!readable(value)) return power(value, digits - 1);
  return fixed(value, value === 0 ? 0 : Math.max(0, digits - 1 - magnitude(value)));
}

// A value read off a curve: a thousandth of what is shown is all that the eye can ask for, and far less is none.
export function reading(value: number, span: number): string {
  if (!Number.isFinite(value)) return "–";
  const none = Math.abs(value) < 1e-4 * span;
  if (!none && (!readable(value) || !(span > 0) || span > 1e7)) return significant(value);
  return fixed(value, Math.min(10, Math.max(0, 2 - magnitude(span))));
}

function decimalsOf(step: number): number {
  let decimals = 0;
  while (decimals < 12 && Math.abs(step - Number(step.toFixed(decimals))) > 1e-6 * step) ++decimals;
  return decimals;
}

export function tickTexts(ticks: readonly (number | null)[], step: number): string[] {
  const largest = Math.max(...ticks.map((tick) => Math.abs(tick ?? 0)));
  const powers = largest >= 1e6 || (step < 1e-5 && largest < 1e3 * step);
  const decimals = powers ? 0 : decimalsOf(step);
  const text = (tick: number): string =>
    powers && tick !== 0 ? power(Number(tick.toPrecision(8))) : fixed(tick, decimals);
  return ticks.map((tick) => (tick === null ? "" : text(tick)));
}

export function logarithmicTickTexts(ticks: readonly (number | null)[]): string[] {
  const text = (tick: number): string => (tick >= 1e-3 && tick < 1e5 ? String(tick) : power(tick));
  return ticks.map((tick) => (tick === null ? "" : text(Number(tick.toPrecision(6)))));
}

// "m/s^2" as "m/s²", where a unit is shown: units alone, so that a file "run^2.nc" keeps its name.
export const raisePowers = (text: string): string =>
  text.replace(
    /((?<![A-Za-z])(?:m|mm|km|s|kg|N|rad|deg|Hz)|\))\^([23])(?![\w.])/g,
    (_all, before: string, digit: string) => before + raised[Number(digit)],
  );
// On an instrument: "deg/s" as "°/s".
export const unitSymbol = (unit: string): string => raisePowers(unit).replace(/\bdeg\b/g, "°");

// Of its like, or of one of its unit, nothing but round-off.
export const withoutRoundOff = (value: number, size: number): number =>
  Math.abs(value) < roundOff * Math.max(size, 1) ? 0 : value;
export const largest = (values: ArrayLike<number>): number =>
  Array.prototype.reduce.call<ArrayLike<number>, [(max: number, value: number) => number, number], number>(
    values, (max, value) => Math.max(max, Math.abs(value) || 0), 0);
