/**
 * Runs tasks `{ name, needs: names, run: () => Promise }`, at most `lanes` at a time. A free lane takes the first task of
 * the list whose needs have been done. `failed(name, error)` is told of a task that threw, and, with null, of each that
 * needs it and is therefore not run.
 */
export async function inLanes(tasks, lanes, failed) {
  const waiting = [...tasks];
  const done = new Set();
  const lost = new Set();
  const running = new Set();
  for (;;) {
    const doomed = waiting.findIndex(({ needs }) => needs.some((need) => lost.has(need)));
    if (doomed >= 0) {
      const [{ name }] = waiting.splice(doomed, 1);
      lost.add(name);
      failed(name, null);
      continue;
    }
    const next = waiting.findIndex(({ needs }) => needs.every((need) => done.has(need)));
    if (next >= 0 && running.size < lanes) {
      const [task] = waiting.splice(next, 1);
      const end = task
        .run()
        .then(() => done.add(task.name))
        .catch((error) => {
          lost.add(task.name);
          failed(task.name, error);
        })
        .finally(() => running.delete(end));
      running.add(end);
    } else if (running.size > 0) {
      await Promise.race(running);
    } else {
      return;
    }
  }
}
