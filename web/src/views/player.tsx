// The pictures of one job; they can be scrubbed while it runs.

import {useSignalEffect} from "@preact/signals";
import {useEffect, useMemo, useRef, useState} from "preact/hooks";
import {frameUrl} from "../api";
import {useKeys} from "../keys";
import {Pictures} from "../media/pictures";
import {type Playback, useStopping} from "../playback";
import {Controls} from "./controls";
import {IconButton} from "../ui/parts";

export function Player({id, name, playback, live}: {id: string; name: string; playback: Playback; live: boolean}) {
  const figure = useRef<HTMLElement>(null);
  const stage = useRef<HTMLDivElement>(null);
  const [failed, setFailed] = useState<number | null>(null);
  const [shown, setShown] = useState(false);
  const pictures = useMemo(() => new Pictures((index) => frameUrl(id, index)), [id]);
  useStopping(playback);

  useEffect(() => {
    playback.ready = (index) => pictures.get(index);
    return () => {
      playback.ready = () => Promise.resolve();
      pictures.clear();
    };
  }, [pictures]);

  // Only the picture asked for last is shown: those that come late are left.
  useSignalEffect(() => {
    const index = playback.index.value;
    if (playback.count.value === 0) return;
    if (playback.playing.value) pictures.prepare(index, playback.count.value);
    pictures.get(index).then((picture) => {
      if (playback.index.peek() !== index || !stage.current) return;
      picture.alt = `${name}, frame ${index}`;
      stage.current.replaceChildren(picture);
      setShown(true);
      setFailed(null);
    }, () => {
      if (playback.index.peek() === index && stage.current) setFailed(index);
    });
  });

  const full = () => {
    if (document.fullscreenElement) void document.exitFullscreen();
    else void figure.current?.requestFullscreen?.();
  };
  useKeys("Frames", [...playback.keys(), {keys: ["f"], words: "Full screen", run: full}]);

  return (
    <figure class="player" ref={figure} aria-label="Frames">
      <div class="stage">
        <div class="picture" ref={stage} onClick={() => playback.toggle()} />
        {!shown && failed === null && (
          <p class="stage-words">{live ? "The first frame is on its way." : playback.count.value === 0 ? "There are no frames." : ""}</p>
        )}
        {failed !== null && <p class="stage-words">Frame {failed} could not be loaded.</p>}
      </div>
      <Controls playback={playback} live={live}>
        <IconButton icon="full" label="Full screen" run={full} />
      </Controls>
    </figure>
  );
}
