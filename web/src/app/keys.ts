// What each key of the page does; panels/help.ts tells it.
import type { LookInside } from '../panels/look_inside_later.ts';
import type { Player } from '../replay/player.ts';
import type { Picture } from '../stage/picture.ts';
import type { RunControl } from '../stage/run_control.ts';
import { colourings, paces, type Mark, type Pace, type Settings } from '../state/settings.ts';
import { cameraKeys } from './camera_keys.ts';
import type { History } from './history.ts';
import type { KeyActions } from './keyboard.ts';

export interface KeyHost {
  settings(): Settings;
  change(patch: Partial<Settings>): void;
  toggleMark(mark: Mark): void;
  setPace(pace: Pace): void;
  openFile(): void;
  help(): void;
  history: History;
  worst(): void;
  run: RunControl;
  player: Player;
  picture: Picture;
  inside: LookInside;
}

export function keyActions(host: KeyHost): KeyActions {
  const { run, player, inside } = host;
  const mark = (name: Mark) => () => host.toggleMark(name);
  const pace = (by: 1 | -1) => () =>
    host.setPace(paces[Math.max(0, Math.min(paces.length - 1, paces.indexOf(player.pace) + by))]);
  const hexes = (action: () => void) => () => {
    if (player.mesh.dim === 3) action();
  };
  const cut = (axis: 0 | 1 | 2) =>
    hexes(() => {
      inside.setOpen(true);
      inside.cutAcross(axis);
    });
  return {
    ' ': () => run.togglePlay(),
    ArrowLeft: () => run.step(-1),
    ArrowRight: () => run.step(1),
    'Shift+ArrowLeft': () => player.stepIteration(-1),
    'Shift+ArrowRight': () => player.stepIteration(1),
    Home: () => player.seek(0),
    End: () => player.seek(player.events.length),
    '+': pace(1),
    '-': pace(-1),
    t: mark('tags'),
    l: mark('layer'),
    h: mark('hull'),
    b: mark('buffer'),
    m: mark('ellipses'),
    c: () => {
      const { colouring } = host.settings();
      host.change({ colouring: colourings[(colourings.indexOf(colouring) + 1) % colourings.length] });
    },
    ...cameraKeys(() => host.picture),
    i: hexes(() => inside.setOpen(!inside.isOpen())),
    x: cut(0),
    y: cut(1),
    z: cut(2),
    Delete: hexes(() => inside.isolate('without')),
    n: hexes(() => inside.isolate('around')),
    e: hexes(() => {
      const now = host.settings().inside;
      inside.setOpen(true);
      host.change({ inside: { ...now, irregular: !now.irregular } });
    }),
    'Ctrl+z': () => host.history.undo(),
    'Ctrl+y': () => host.history.redo(),
    'Ctrl+Shift+z': () => host.history.redo(),
    w: () => host.worst(),
    o: () => host.openFile(),
    '?': () => host.help(),
  };
}
