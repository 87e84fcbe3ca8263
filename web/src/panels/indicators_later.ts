// The panel of numbers: its place is there at once, what fills it comes with the first numbers.
import { h } from '../ui/dom.ts';
import type { IndicatorActions, Indicators } from './indicators.ts';

/** The calls of a panel that is still to come, made once it is there. */
type Later = Omit<Indicators, 'content'> & { element: HTMLElement };

export function makeIndicators(actions: IndicatorActions): Later {
  const element = h(
    'aside',
    { class: 'panel numbers', 'aria-label': 'Indicators', tabindex: 0 },
    h('h2', {}, 'The mesh in numbers'),
  );
  const loading = import('./indicators.ts').then((module) => {
    const made = module.makeIndicators(actions);
    element.append(...made.content);
    return made;
  });
  return {
    element,
    setCase: (name) => void loading.then((made) => made.setCase(name)),
    setPicked: (measure, range) => void loading.then((made) => made.setPicked(measure, range)),
    setIdealCells: (count) => void loading.then((made) => made.setIdealCells(count)),
    setIrregular: (count) => void loading.then((made) => made.setIrregular(count)),
    update: (numbers) => void loading.then((made) => made.update(numbers)),
  };
}
