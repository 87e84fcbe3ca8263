import '../element/index.ts';
import { startLesson } from './lesson.ts';

startLesson();
document.documentElement.dataset.started = ''; // public/fallback.js looks for it
