// What is looked at: kept in the address, so that a link shows the same.

export interface View {
  recording: number; trajectory: string; shown: string[]; begin: number; end: number;  // steps [begin, end); 0, 0: all
  step: number; contestant: string; color: "time" | "error";
}

type Listener = (view: View, changed: Set<keyof View>) => void;

export class State {
  private listeners: Listener[] = [];
  constructor(public view: View) {}

  listen(listener: Listener): void { this.listeners.push(listener); }

  set(change: Partial<View>): void {
    const changed = new Set<keyof View>();
    for (const key of Object.keys(change) as (keyof View)[]) {
      if (JSON.stringify(this.view[key]) !== JSON.stringify(change[key])) changed.add(key);
    }
    if (!changed.size) return;
    this.view = { ...this.view, ...change };
    history.replaceState(null, "", "#" + this.text());
    for (const listener of this.listeners) listener(this.view, changed);
  }

  text(): string {
    const { recording, trajectory, shown, begin, end, step, contestant, color } = this.view;
    const parts = new URLSearchParams();
    if (recording) parts.set("recording", String(recording));
    parts.set("trajectory", trajectory);
    if (shown.length) parts.set("shown", shown.join("~"));
    if (end > begin) parts.set("steps", `${begin}-${end}`);
    parts.set("step", String(step));
    parts.set("contestant", contestant);
    if (color !== "time") parts.set("color", color);
    return parts.toString();
  }

  /** What the address asks for. */
  static asked(): Partial<View> {
    const parts = new URLSearchParams(location.hash.slice(1)), view: Partial<View> = {};
    const whole = (text: string | null) => text !== null && /^\d+$/.test(text) ? Number(text) : undefined;
    const recording = whole(parts.get("recording")), step = whole(parts.get("step"));
    if (recording !== undefined) view.recording = recording;
    if (step !== undefined) view.step = step;
    if (parts.has("trajectory")) view.trajectory = parts.get("trajectory")!;
    if (parts.has("contestant")) view.contestant = parts.get("contestant")!;
    if (parts.has("shown")) view.shown = parts.get("shown")!.split("~");
    if (parts.get("color") === "error") view.color = "error";
    const range = /^(\d+)-(\d+)$/.exec(parts.get("steps") ?? "");
    if (range) [view.begin, view.end] = [Number(range[1]), Number(range[2])];
    return view;
  }
}
