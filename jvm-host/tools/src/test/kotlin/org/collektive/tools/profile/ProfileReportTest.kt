package org.collektive.tools.profile

import jdk.jfr.Recording
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import java.io.IOException
import java.nio.file.Path
import kotlin.io.path.readBytes
import kotlin.io.path.writeBytes
import kotlin.test.assertContains
import kotlin.test.assertFailsWith

/** Tests the summary of flight recordings. */
internal class ProfileReportTest {
    @Test
    fun `a truncated recording is reported`(@TempDir folder: Path) {
        val whole = folder.resolve("whole.jfr")
        Recording().use {
            it.enable("jdk.JVMInformation")
            it.start()
            it.stop()
            it.dump(whole)
        }
        assertContains(ProfileReport().read(whole).text(), "no ticks")
        val bytes = whole.readBytes()
        val part = folder.resolve("part.jfr")
        for (length in bytes.indices step bytes.size / 40) {
            part.writeBytes(bytes.copyOf(length))
            assertFailsWith<IOException>("$length of ${bytes.size} bytes") { ProfileReport().read(part) }
        }
    }
}
