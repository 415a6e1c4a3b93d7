// What a person is told of this pixel, as one number: 1 the eye is in a solid, 2 the driver ended
// loops, 4 a march ran out of steps; and 8 for every step.
float pnb_notes(bool inside) {
  bool unfinished = pnb_unfinished || penumbra_out_of_steps;
  return (inside ? 1.0 : 0.0) + (pnb_loops_are_cut() ? 2.0 : 0.0) + (unfinished ? 4.0 : 0.0) +
         8.0 * float(pnb_steps + penumbra_steps_taken);
}
