// What a person is told of this pixel, as one number: 1 it came to its end, 2 the eye is in a
// solid, 4 the driver ended loops, 8 a march ran out of steps; and 16 for every step.
float pnb_notes(bool inside) {
  bool unfinished = pnb_unfinished || penumbra_out_of_steps;
  return 1.0 + (inside ? 2.0 : 0.0) + (pnb_loops_are_cut() ? 4.0 : 0.0) +
         (unfinished ? 8.0 : 0.0) + 16.0 * float(pnb_steps + penumbra_steps_taken);
}
