import { startEmbed } from './embed.ts';

startEmbed();
document.documentElement.dataset.started = ''; // public/fallback.js looks for it
