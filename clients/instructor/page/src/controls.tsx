// Small controls that all cards share.
import type { ComponentChildren } from 'preact';
import { useState } from 'preact/hooks';
import type { Unit } from './units';

export function Card(props: { title: string; id: string; aside?: ComponentChildren; children: ComponentChildren }) {
  return (
    <section class={`card card-${props.id}`} aria-labelledby={`title-${props.id}`}>
      <header>
        <h2 id={`title-${props.id}`}>{props.title}</h2>
        {props.aside}
      </header>
      {props.children}
    </section>
  );
}

/** A number that counts once it is committed: by Enter or by leaving the field. Until then it looks so. */
export function NumberField(props: {
  label: string;
  id: string;
  value: number;
  unit?: Unit;
  unitName?: string;
  decimals?: number;
  min: number;
  max: number;
  step?: number;
  commit: (value: number) => void;
}) {
  const size = props.unit?.size ?? 1;
  const decimals = props.unit?.decimals ?? props.decimals ?? 0;
  const [draft, setDraft] = useState<string | null>(null);
  const text = (props.value / size).toFixed(decimals);
  const commit = () => {
    if (draft === null) return;
    setDraft(null);
    const value = Number(draft.replace(',', '.')) * size;
    if (draft.trim() !== '' && Number.isFinite(value) && draft !== text)
      props.commit(Math.min(Math.max(value, props.min), props.max));
  };
  return (
    <label class="field" for={props.id}>
      <span>{props.label}</span>
      <span class="box">
        <input
          id={props.id}
          inputMode="decimal"
          class={draft === null ? '' : 'pending'}
          value={draft ?? text}
          onInput={(event) => setDraft(event.currentTarget.value)}
          onBlur={commit}
          onKeyDown={(event) => {
            if (event.key === 'Enter') commit();
            if (event.key === 'Escape') setDraft(null);
            const turn = event.key === 'ArrowUp' ? 1 : event.key === 'ArrowDown' ? -1 : 0;
            if (turn === 0) return;
            event.preventDefault();
            const next = Number(draft ?? text) + turn * (props.step ?? 1);
            setDraft(next.toFixed(decimals));
          }}
        />
        <span class="unit">{props.unit?.name ?? props.unitName}</span>
      </span>
    </label>
  );
}

export function Choice<T extends string>(props: {
  label: string;
  options: readonly { value: T; text: string }[];
  value: T;
  choose: (value: T) => void;
}) {
  return (
    <div class="choice" role="group" aria-label={props.label}>
      {props.options.map((option) => (
        <button
          type="button"
          key={option.value}
          aria-pressed={option.value === props.value}
          onClick={() => props.choose(option.value)}
        >
          {option.text}
        </button>
      ))}
    </div>
  );
}

export function UnitChoice(props: { label: string; units: Unit[]; unit: Unit; choose: (name: string) => void }) {
  const options = props.units.map((unit) => ({ value: unit.name, text: unit.name }));
  return <Choice label={`unit of ${props.label}`} options={options} value={props.unit.name} choose={props.choose} />;
}
