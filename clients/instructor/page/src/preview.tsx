// What the crew sees: the newest picture of each channel.
import { useEffect, useRef, useState } from 'preact/hooks';
import { Card } from './controls';

/** Hands pictures to whoever shows their channel. */
export class Pictures {
  private readonly shows = new Map<string, (jpeg: Blob) => void>();

  take(channel: string, jpeg: Blob): void {
    this.shows.get(channel)?.(jpeg);
  }
  show(channel: string, how: ((jpeg: Blob) => void) | undefined): void {
    if (how) this.shows.set(channel, how);
    else this.shows.delete(channel);
  }
}

function Channel(props: { name: string; pictures: Pictures; lively: boolean }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [cameAt, setCameAt] = useState(0);
  useEffect(() => {
    props.pictures.show(props.name, async (jpeg) => {
      const image = await createImageBitmap(jpeg);
      const to = canvas.current;
      if (to) {
        if (to.width !== image.width) to.width = image.width;
        if (to.height !== image.height) to.height = image.height;
        to.getContext('2d')?.drawImage(image, 0, 0);
      }
      image.close();
      setCameAt(Date.now());
    });
    return () => props.pictures.show(props.name, undefined);
  }, [props.name, props.pictures]);
  const stale = !props.lively || Date.now() - cameAt > 3000;
  return (
    <figure class={stale ? 'channel stale' : 'channel'}>
      <canvas ref={canvas} width={640} height={360} data-channel={props.name} role="img"
        aria-label={`picture of channel ${props.name}`} />
      <figcaption>
        {props.name}
        {stale && <span class="bad">{cameAt === 0 ? 'no picture yet' : 'old picture'}</span>}
      </figcaption>
    </figure>
  );
}

export function Preview(props: { channels: string[]; pictures: Pictures; lively: boolean }) {
  const wide = props.channels.length > 1 ? 'channels many' : 'channels';
  return (
    <Card title="What the crew sees" id="preview">
      <div class={wide}>
        {props.channels.map((name) => (
          <Channel key={name} name={name} pictures={props.pictures} lively={props.lively} />
        ))}
        {props.channels.length === 0 && <p class="quiet">The daemon has not said what it shows.</p>}
      </div>
    </Card>
  );
}
