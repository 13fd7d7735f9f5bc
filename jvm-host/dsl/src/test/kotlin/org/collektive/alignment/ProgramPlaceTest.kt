package org.collektive.alignment

import it.unibo.collektive.aggregate.FakeDevice
import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertNull

/** Tests how messages show the tokens of compiled programs. */
class ProgramPlaceTest {
    private fun token(name: String, line: Int) = "$name@Swarm.kt:$line#0123456789abcdef"

    @Test
    fun `a token has a readable name and a location`() {
        assertEquals("share", readable(token("share", 12)))
        assertEquals("Swarm.kt:12", location(token("share", 12)))
    }

    @Test
    fun `other pivots are read as they are and have no place`() {
        for (pivot in listOf("share", "share@Swarm.kt:12", "a@b:1#0123", 12, null)) {
            assertEquals("$pivot", readable(pivot))
            assertNull(location(pivot))
        }
    }

    @Test
    fun `a place has the path, and the innermost line of the sources`() =
        assertEquals("node 3 at helper > 7 > share (Swarm.kt:12)", "${ProgramPlace(3, listOf(token("helper", 4), 7, token("share", 12)))}")

    @Test
    fun `a pivot of the program below a token leaves the token's line`() =
        assertEquals("node 3 at helper > key (Swarm.kt:4)", "${ProgramPlace(3, listOf(token("helper", 4), "key"))}")

    @Test
    fun `without tokens the place is the root`() = assertEquals("node 3 at root", "${ProgramPlace(3, emptyList())}")

    @Test
    fun `a long path is shortened to its beginning and end`() {
        assertEquals((1..11).joinToString(" > "), ProgramPlace(3, (1..11).toList()).path)
        assertEquals("1 > 2 > 3 > 4 > 5 > 6 > 7 > 8 > … (1,990 more) > 1999 > 2000", ProgramPlace(3, (1..2000).toList()).path)
    }

    @Test
    fun `a device that keeps no tokens is at the root`() = assertEquals("broken [node 3 at root]", FakeDevice(3).withPlace("broken"))
}
