package org.collektive.host.programs

import org.collektive.host.shim.HostException
import org.junit.jupiter.api.Test
import java.io.ByteArrayOutputStream
import java.util.zip.ZipEntry
import java.util.zip.ZipOutputStream
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

class ProgramJarTest {
    @Test
    fun `a jar that unpacks to more than 256 MiB is refused`() {
        val packed = ByteArrayOutputStream()
        ZipOutputStream(packed).use { zip ->
            repeat(257) {
                zip.putNextEntry(ZipEntry("$it"))
                zip.write(ByteArray(1 shl 20))
            }
        }
        val refused = assertFailsWith<HostException> { ProgramJar.open(JarBytes("bomb.jar", packed.toByteArray())) }
        assertEquals("the jar bomb.jar contains more than 256 MiB: divide it into several jars", refused.message)
    }
}
