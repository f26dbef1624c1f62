// A weather report, pasted: what it says, then made the weather.
import { useState } from 'preact/hooks';
import { Card } from './controls';
import type { Metar, Send } from './types';

export function Report(props: { metar?: Metar; send: Send }) {
  const [text, setText] = useState('');
  const ready = text.trim() !== '';
  return (
    <Card title="Weather report" id="report">
      <textarea id="metar" rows={2} aria-label="METAR" placeholder="METAR LSZH 011250Z 24012KT 9999 BKN040 15/08 Q1018" value={text}
        onInput={(event) => {
          setText(event.currentTarget.value);
          if (event.currentTarget.value.trim() !== '') props.send({ do: 'decode', text: event.currentTarget.value });
        }} />
      <button type="button" id="apply-metar" disabled={!ready} onClick={() => props.send({ do: 'metar', text })}>Make it the weather</button>
      {ready && props.metar && props.metar.problems !== '' && <p class="bad">{props.metar.problems}</p>}
      {ready && props.metar && <pre tabIndex={0}>{props.metar.page}</pre>}
    </Card>
  );
}
