// Date and time: a dial of the day, a field, and the hours of light that people ask for by name.
import { useRef, useState } from 'preact/hooks';
import { Card, Choice } from './controls';
import type { Almanac, Send, State, Status } from './types';

const kDay = 1440;
const kStep = 5;

function minuteOf(utc: string): number {
  return Number(utc.slice(11, 13)) * 60 + Number(utc.slice(14, 16)) + Number(utc.slice(17, 19) || 0) / 60;
}

function hhmm(minute: number): string {
  const whole = ((Math.floor(minute) % kDay) + kDay) % kDay;
  return `${String(Math.floor(whole / 60)).padStart(2, '0')}:${String(whole % 60).padStart(2, '0')}`;
}

/** Minutes at which the Sun passes that height, upwards or downwards. */
function crossing(almanac: Almanac, height: number, upwards: boolean): number | null {
  for (let i = 1; i < almanac.sun.length; ++i) {
    const before = almanac.sun[i - 1]! - height;
    const after = almanac.sun[i]! - height;
    if (upwards ? before < 0 && after >= 0 : before >= 0 && after < 0)
      return (i - 1 + before / (before - after)) * almanac.step_min;
  }
  return null;
}

function extreme(almanac: Almanac, best: (a: number, b: number) => boolean): number {
  let at = 0;
  for (let i = 1; i < almanac.sun.length; ++i) if (best(almanac.sun[i]!, almanac.sun[at]!)) at = i;
  return at * almanac.step_min;
}

function light(height: number): string {
  return height > 0 ? 'day' : height > -6 ? 'civil' : height > -12 ? 'nautical' : height > -18 ? 'astro' : 'dark';
}

function point(minute: number, radius: number): [number, number] {
  const angle = (minute / kDay) * 2 * Math.PI + Math.PI;
  return [100 + radius * Math.sin(angle), 100 - radius * Math.cos(angle)];
}

function arc(from: number, to: number, radius: number): string {
  const [x0, y0] = point(from, radius);
  const [x1, y1] = point(to, radius);
  return `M${x0.toFixed(2)} ${y0.toFixed(2)}A${radius} ${radius} 0 0 1 ${x1.toFixed(2)} ${y1.toFixed(2)}`;
}

function Dial(props: { almanac?: Almanac; minute: number; set: (minute: number) => void }) {
  const dial = useRef<SVGSVGElement>(null);
  const [drag, setDrag] = useState<number | null>(null);
  const minute = drag ?? props.minute;
  const [x, y] = point(minute, 78);
  const at = (event: PointerEvent) => {
    const box = dial.current!.getBoundingClientRect();
    const dx = event.clientX - (box.left + box.width / 2);
    const dy = event.clientY - (box.top + box.height / 2);
    const raw = ((Math.atan2(dx, -dy) - Math.PI) / (2 * Math.PI)) * kDay;
    return ((Math.round(raw / kStep) * kStep) % kDay + kDay) % kDay;
  };
  const turn = (by: number) => props.set(((Math.round(props.minute) + by) % kDay + kDay) % kDay);
  return (
    <svg ref={dial} class="dial" viewBox="0 0 200 200" role="slider" tabindex={0} aria-label="time of day, UTC"
      aria-valuemin={0} aria-valuemax={kDay - 1} aria-valuenow={Math.round(minute)} aria-valuetext={`${hhmm(minute)} UTC`}
      onPointerDown={(event) => { dial.current!.setPointerCapture(event.pointerId); setDrag(at(event)); }}
      onPointerMove={(event) => { if (drag !== null) setDrag(at(event)); }}
      onPointerUp={(event) => { if (drag !== null) props.set(at(event)); setDrag(null); }}
      onPointerCancel={() => setDrag(null)}
      onKeyDown={(event) => {
        const by: Record<string, number> = { ArrowRight: 5, ArrowUp: 5, ArrowLeft: -5, ArrowDown: -5, PageUp: 60, PageDown: -60 };
        const step = by[event.key];
        if (step === undefined) return;
        event.preventDefault();
        turn(step);
      }}>
      {props.almanac?.sun.slice(1).map((height, i) => (
        <path key={i} class={`light ${light((height + props.almanac!.sun[i]!) / 2)}`} fill="none"
          d={arc(i * props.almanac!.step_min, (i + 1) * props.almanac!.step_min + 1, 90)} />
      ))}
      {Array.from({ length: 8 }, (_, i) => {
        const [tx, ty] = point(i * 180, 68);
        return <text key={i} x={tx} y={ty} class="hour">{String(i * 3).padStart(2, '0')}</text>;
      })}
      <line class="hand" x1={100} y1={100} x2={x} y2={y} />
      <circle class="knob" cx={x} cy={y} r={drag === null ? 8 : 11} />
      <circle class="hub" cx={100} cy={100} r={4} />
      {drag !== null && <text x={100} y={88} class="dragged">{hhmm(drag)}</text>}
    </svg>
  );
}

function DayStrip(props: { almanac: Almanac; minute: number }) {
  const { almanac } = props;
  const line = (heights: number[]) =>
    heights.map((height, i) => `${((i * almanac.step_min) / kDay) * 300},${40 - (height / 90) * 36}`).join(' ');
  return (
    <svg class="strip" viewBox="0 0 300 80" role="img" preserveAspectRatio="none"
      aria-label={`heights of Sun and Moon on ${almanac.date}; the times stand below`}>
      {almanac.sun.slice(1).map((height, i) => (
        <rect key={i} class={`light ${light((height + almanac.sun[i]!) / 2)}`} y={0} height={80}
          x={((i * almanac.step_min) / kDay) * 300} width={(almanac.step_min / kDay) * 300 + 0.5} />
      ))}
      <line class="horizon" x1={0} x2={300} y1={40} y2={40} />
      <polyline class="moon" points={line(almanac.moon)} />
      <polyline class="sun" points={line(almanac.sun)} />
      <line class="now" y1={0} y2={80} x1={(props.minute / kDay) * 300} x2={(props.minute / kDay) * 300} />
    </svg>
  );
}

const kEventNames: Record<string, string> = {
  astronomical_dawn: 'astronomical dawn', nautical_dawn: 'nautical dawn', civil_dawn: 'civil dawn',
  civil_dusk: 'civil dusk', nautical_dusk: 'nautical dusk', astronomical_dusk: 'astronomical dusk',
};

function Times(props: { almanac: Almanac; minute: number }) {
  const next = props.almanac.events.find((event) => minuteOf(event.utc) > props.minute && event.kind.includes('_d'));
  return (
    <dl class="times">
      {props.almanac.events.map((event) => (
        <div key={event.utc + event.kind} class={event === next ? 'next' : ''}>
          <dt>{kEventNames[event.kind] ?? `${event.body === 'sun' ? 'Sun' : 'Moon'} ${event.kind}`}</dt>
          <dd>{event.utc.slice(11, 16)}</dd>
        </div>
      ))}
    </dl>
  );
}

export function Clock(props: { state: State; status: Status; almanac?: Almanac; fastest: number; send: Send }) {
  const { state, status, almanac, send } = props;
  const [draft, setDraft] = useState<string | null>(null);
  const minute = minuteOf(status.utc);
  const date = status.utc.slice(0, 10);
  const set = (to: number) => send({ do: 'clock', utc: `${date}T${hhmm(to)}:00Z` });
  const commit = () => {
    if (draft !== null && /^\d\d?:\d\d(:\d\d)?$/.test(draft)) {
      const [hour = '0', ...rest] = draft.split(':');
      send({ do: 'clock', utc: `${date}T${[hour.padStart(2, '0'), ...rest].join(':')}Z` });
    }
    setDraft(null);
  };
  const named: [string, number | null][] = almanac
    ? [['Dawn', crossing(almanac, -3, true)], ['Noon', extreme(almanac, (a, b) => a > b)],
       ['Dusk', crossing(almanac, -3, false)], ['Night', extreme(almanac, (a, b) => a < b)]]
    : [];
  const solar = almanac ? hhmm(minute + almanac.solar_h * 60) : '--:--';
  const sun = status.world?.sun;
  const moon = status.world?.moon;
  return (
    <Card title="Date and time" id="clock"
      aside={<span class="quiet">{status.clock_shown ? '' : 'on its way'}</span>}>
      <div class="clock">
        <Dial almanac={almanac} minute={minute} set={set} />
        <div class="clock-fields">
          <label class="field" for="utc"><span>UTC</span>
            <input id="utc" class={draft === null ? 'big' : 'big pending'} value={draft ?? status.utc.slice(11, 19)}
              inputMode="numeric"
              onFocus={() => setDraft(status.utc.slice(11, 16))}
              onInput={(event) => setDraft(event.currentTarget.value)} onBlur={commit}
              onKeyDown={(event) => {
                if (event.key === 'Enter') event.currentTarget.blur();
                if (event.key === 'Escape') setDraft(null);
              }} />
          </label>
          <label class="field" for="date"><span>Date</span>
            <input id="date" type="date" value={date} min="1900-01-01" max="2100-12-31"
              onChange={(event) => event.currentTarget.value !== '' &&
                send({ do: 'clock', utc: `${event.currentTarget.value}T${status.utc.slice(11, 19)}Z` })} />
          </label>
          <p class="quiet">{solar} mean time at the site</p>
        </div>
      </div>
      <div class="row">
        {named.map(([text, at]) => (
          <button type="button" key={text} data-time={text.toLowerCase()} disabled={at === null}
            title={at === null ? 'The Sun does not do so on this day' : `${hhmm(at)} UTC`}
            onClick={() => at !== null && set(at)}>{text}</button>
        ))}
      </div>
      <div class="row">
        <button type="button" aria-pressed={!state.clock.running}
          onClick={() => send({ do: 'clock', running: !state.clock.running })}>Freeze</button>
        <Choice label="speed of the clock" value={String(state.clock.speed)}
          options={[1, 10, props.fastest].map((speed) => ({ value: String(speed), text: `×${speed}` }))}
          choose={(speed) => send({ do: 'clock', speed: Number(speed) })} />
      </div>
      {almanac && <DayStrip almanac={almanac} minute={minute} />}
      {sun && moon && (
        <p class="quiet">
          Sun {sun.elevation_deg.toFixed(1)}° at {sun.azimuth_deg.toFixed(0)}°, Moon {moon.elevation_deg.toFixed(1)}° at{' '}
          {moon.azimuth_deg.toFixed(0)}°, {(moon.lit_fraction * 100).toFixed(0)} % lit
        </p>
      )}
      {almanac && <Times almanac={almanac} minute={minute} />}
    </Card>
  );
}
