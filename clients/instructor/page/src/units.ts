// Units that people choose, and how they are remembered.
import { useState } from 'preact/hooks';

export interface Unit {
  name: string;
  /** SI units in one of it. */
  size: number;
  decimals: number;
}

export const kFoot = 0.3048;
export const kKnot = 1852 / 3600;

export const kDistances: Unit[] = [
  { name: 'm', size: 1, decimals: 0 },
  { name: 'km', size: 1000, decimals: 2 },
  { name: 'mi', size: 1609.344, decimals: 2 },
  { name: 'ft', size: kFoot, decimals: 0 },
];
export const kHeights: Unit[] = [
  { name: 'ft', size: kFoot, decimals: 0 },
  { name: 'm', size: 1, decimals: 0 },
];
export const kSpeeds: Unit[] = [
  { name: 'kt', size: kKnot, decimals: 0 },
  { name: 'm/s', size: 1, decimals: 1 },
];

export function shown(value: number, unit: Unit): string {
  return (value / unit.size).toFixed(unit.decimals);
}

/** A choice that this browser remembers. */
export function useRemembered(key: string, first: string): [string, (value: string) => void] {
  const [value, set] = useState(() => localStorage.getItem(key) ?? first);
  return [value, (next: string) => {
    localStorage.setItem(key, next);
    set(next);
  }];
}

export function useUnit(key: string, units: Unit[], first: string): [Unit, (name: string) => void] {
  const [name, set] = useRemembered(`unit.${key}`, first);
  return [units.find((unit) => unit.name === name) ?? units[0]!, set];
}
