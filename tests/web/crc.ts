/** The table of the cyclic redundancy check of PNG (polynomial 0xedb88320). */
export const crc32Table = Array.from({length: 256}, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c >>> 0;
});
