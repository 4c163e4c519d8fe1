// Line icons, 16 px, drawn with the colour of the text around them. They say nothing by themselves: what they stand in has a name.

const paths: Record<string, string> = {
  play: "M5 3.5v9l7.5-4.5z",
  pause: "M5.5 3.5v9M10.5 3.5v9",
  first: "M4 3.5v9M12 3.5 6 8l6 4.5z",
  last: "M12 3.5v9M4 3.5 10 8l-6 4.5z",
  previous: "M10 3.5 5 8l5 4.5",
  next: "M6 3.5 11 8l-5 4.5",
  cancel: "M4 4l8 8M12 4l-8 8",
  retry: "M12.7 6.5A5 5 0 1 0 13 9M13 3.2v3.5H9.5",
  remove: "M3 4.5h10M6.3 4.5V3h3.4v1.5M4.5 4.5l.6 8.5h5.8l.6-8.5M6.8 7v3.8M9.2 7v3.8",
  copy: "M5.5 5.5h7v7h-7zM3.5 10.5v-7h7",
  full: "M3 6V3h3M10 3h3v3M13 10v3h-3M6 13H3v-3",
  loop: "M3.5 8V6.5a2 2 0 0 1 2-2h6M9.5 2.5l2 2-2 2M12.5 8v1.5a2 2 0 0 1-2 2h-6M6.5 13.5l-2-2 2-2",
  download: "M8 2.5v7.5M4.8 7 8 10.2 11.2 7M3 13h10",
  longer: "M2.5 8h9M8.5 4.5 12 8l-3.5 3.5M14 4v8",
  plus: "M8 3.5v9M3.5 8h9",
  compare: "M2.5 3.5h4.5v9H2.5zM9 3.5h4.5v9H9z",
  search: "M7 3a4 4 0 1 1 0 8 4 4 0 0 1 0-8M10 10l3 3",
  light: "M8 5.2a2.8 2.8 0 1 1 0 5.6 2.8 2.8 0 0 1 0-5.6M8 1.5v1.3M8 13.2v1.3M1.5 8h1.3M13.2 8h1.3M3.4 3.4l.9.9M11.7 11.7l.9.9M3.4 12.6l.9-.9M11.7 4.3l.9-.9",
  dark: "M13 9.6A5.4 5.4 0 0 1 6.4 3a5.4 5.4 0 1 0 6.6 6.6z",
  auto: "M8 2.5a5.5 5.5 0 1 1 0 11zM8 2.5a5.5 5.5 0 1 0 0 11z",
  keyboard: "M1.5 4.5h13v7h-13zM4 7h.1M6.5 7h.1M9 7h.1M11.5 7h.1M5 9.5h6",
  upload: "M8 10.5V3M4.8 6 8 2.8 11.2 6M3 13h10",
  edit: "M3 13l.6-2.8L10.8 3 13 5.2 5.8 12.4zM9.4 4.4l2.2 2.2",
};

export function Icon({name}: {name: keyof typeof paths & string}) {
  const filled = name === "play";
  return (
    <svg class={`icon ${filled ? "filled" : ""} icon-${name}`} viewBox="0 0 16 16" width="16" height="16" aria-hidden="true">
      <path d={paths[name]} />
    </svg>
  );
}
