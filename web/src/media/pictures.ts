// Pictures of frames, decoded before they are shown; the last used ones are kept.

const kept = 48;
const ahead = 6;

export class Pictures {
  private readonly pictures = new Map<number, HTMLImageElement>();
  constructor(private readonly address: (index: number) => string) {}

  /** Resolves with the picture when it can be shown; rejects where there is none. */
  async get(index: number): Promise<HTMLImageElement> {
    const picture = this.ask(index);
    try {
      await picture.decode();
      return picture;
    } catch (error) {
      if (this.pictures.get(index) === picture) this.pictures.delete(index);
      throw error;
    }
  }

  /** Fetches those that are due soon. */
  prepare(index: number, count: number) {
    for (let i = index + 1; i <= Math.min(index + ahead, count - 1); ++i) this.ask(i);
  }

  clear() {
    this.pictures.clear();
  }

  private ask(index: number): HTMLImageElement {
    let picture = this.pictures.get(index);
    if (!picture) {
      picture = new Image();
      picture.decoding = "async";
      picture.src = this.address(index);
    }
    // To the end: the first is the one not used for longest.
    this.pictures.delete(index);
    this.pictures.set(index, picture);
    if (this.pictures.size > kept) this.pictures.delete(this.pictures.keys().next().value!);
    return picture;
  }
}
