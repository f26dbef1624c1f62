// How link, frames and plan stand.
import { useEffect, useRef } from 'preact/hooks';
import { Card } from './controls';
import type { Status } from './types';

const kKept = 240;

function Plot(props: { status: Status }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const kept = useRef<{ median: number; p95: number }[]>([]);
  const { recent, rate_hz = 60 } = props.status;
  useEffect(() => {
    const to = canvas.current?.getContext('2d');
    if (!recent || !to) return;
    kept.current = [...kept.current, { median: recent.median_ms, p95: recent.p95_ms }].slice(-kKept);
    const { width, height } = to.canvas;
    const style = getComputedStyle(to.canvas);
    const budget = 1000 / rate_hz;
    const most = Math.max(budget * 1.5, ...kept.current.map((one) => one.p95)) * 1.05;
    to.clearRect(0, 0, width, height);
    const line = (value: (i: number) => number, colour: string) => {
      to.strokeStyle = style.getPropertyValue(colour);
      to.lineWidth = 2;
      to.beginPath();
      kept.current.forEach((_, i) => to.lineTo((i / (kKept - 1)) * width, height * (1 - value(i) / most)));
      to.stroke();
    };
    line((i) => kept.current[i]!.p95, '--warm');
    line((i) => kept.current[i]!.median, '--text');
    to.strokeStyle = style.getPropertyValue('--bad');
    to.setLineDash([6, 6]);
    to.strokeRect(-4, height * (1 - budget / most), width + 8, height * 2);
    to.setLineDash([]);
  }, [props.status]);
  if (!recent) return null;
  return (
    <>
      <canvas ref={canvas} class="plot" width={600} height={120} role="img" aria-label="frame times of the last two minutes; numbers below" />
      <p class="quiet">Frame: median {recent.median_ms.toFixed(1)} ms, 95 % {recent.p95_ms.toFixed(1)} ms, budget {(1000 / rate_hz).toFixed(1)} ms
        (dashed); {recent.rate_hz.toFixed(0)} frames a second, {recent.late} of the last {recent.frames} late.</p>
    </>
  );
}

export function LinkFacts(props: { status: Status }) {
  const { status } = props;
  return (
    <Card title="Link and frames" id="link">
      <Plot status={status} />
      <table>
        <thead><tr><th>Source</th><th>Link</th><th>Has the say about</th></tr></thead>
        <tbody>
          {(status.sources ?? []).map((source) => (
            <tr key={source.name}><td>{source.name}</td><td class={source.link === 'live' ? '' : 'warm'}>{source.link}</td>
              <td>{source.holds.join(', ') || '–'}</td></tr>
          ))}
        </tbody>
      </table>
      <p class="quiet">
        {status.world && <>Mode {status.world.mode}. Weather changes over {status.world.weather.transition_s} s. </>}
        {status.host?.address && <>Host {status.host.address}, {status.host.frames_behind_median} frames behind. </>}
        {status.said_again > 0 && <>Said again: {status.said_again}. </>}
        {status.renderer && <>Drawn by OpenGL {status.renderer}.</>}
      </p>
    </Card>
  );
}

export function Plan(props: { status: Status }) {
  const plan = props.status.plan ?? [];
  return (
    <Card title="What is drawn, and why" id="plan">
      <table>
        <tbody>
          {plan.map((pass) => (
            <tr key={pass.pass} class={pass.needed ? '' : 'off'}><th scope="row">{pass.pass}</th><td>{pass.needed ? 'drawn' : 'left out'}</td>
              <td>{pass.reason}</td></tr>
          ))}
        </tbody>
      </table>
    </Card>
  );
}

const kHostOwns = 'The flight model places and freezes the aircraft; CIGI has no packet by which a station could ask it to.';

export function Flight() {
  return (
    <Card title="Aircraft" id="flight">
      <div class="row">
        {['Line-up', '3 nm final', '10 nm final', 'Flight freeze'].map((text) => (
          <button type="button" key={text} disabled aria-describedby="why-not">{text}</button>
        ))}
      </div>
      <p class="quiet" id="why-not">{kHostOwns}</p>
    </Card>
  );
}
